"""The wait for a key on an episode's first frame, where a person drives."""

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import has_driving_keys


class StartWait:
    """State of a wait on an episode's first frame, until a person presses a key.

    Nobody loses time while looking at a new start: the whole world stands still, opponents and
    clocks included. The world's thread calls the methods; any thread may read :attr:`is_waiting`.

    Args:
        is_enabled: False never waits; True waits where the world's ``wait_for_key`` says so.
    """

    def __init__(self, *, is_enabled: bool) -> None:
        self._is_enabled = is_enabled
        self._begun: tuple[ControlRequestor, int] | None = None
        self.is_waiting = False
        """True if the world waited when it was last asked about."""

    def update(self, sim: ControlRequestor) -> bool:
        """Return True if a world waits now."""
        self.is_waiting = (
            self._is_enabled
            and sim.wait_for_key
            and sim.world.ticks == 0
            and self._begun != (sim, sim.episode)
            and any(has_driving_keys(agent) for agent in sim.agents)
        )
        return self.is_waiting

    def reason(self, sim: ControlRequestor, *, is_held: bool, has_error: bool) -> str:
        """Return what a world waits for now; see :attr:`Snapshot.waiting`."""
        is_for_key = self.update(sim)
        if is_held:
            return "teacher"
        return "key" if is_for_key and not has_error else ""

    def begins(self, sim: ControlRequestor) -> bool:
        """Return True if a world waits now and did not before."""
        was_waiting = self.is_waiting
        return self.update(sim) and not was_waiting

    def end(self, sim: ControlRequestor) -> None:
        """Let a world's present episode run."""
        self._begun = (sim, sim.episode)
