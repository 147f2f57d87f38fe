"""The time of an episode, which stops when the episode is over."""

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import has_driving_keys


class EpisodeClock:
    """The time (s) of a world's present episode, for people.

    The world goes on after an episode's end, until somebody resets it; that is not counted. Where
    persons drive, an episode is over when their agents' are; else when all agents' are. Belongs to
    the world's thread.
    """

    def __init__(self) -> None:
        self._episode: tuple[ControlRequestor, int] | None = None
        self._ended_at: dict[tuple[str, int], float] = {}

    def note_ends(self, sim: ControlRequestor) -> None:
        """Note which agents' episodes are over; to be called after each tick."""
        if self._episode != (sim, sim.episode):
            self._episode = sim, sim.episode
            self._ended_at.clear()
        for agent in sim.agents:
            if agent.done:
                self._ended_at.setdefault((agent.id, agent.episode), sim.world.time)

    def read(self, sim: ControlRequestor) -> float:
        """Return the time at which the episode was over, or the present time of the world."""
        self.note_ends(sim)
        if not self._ended_at:
            return sim.world.time
        players = [agent for agent in sim.agents if has_driving_keys(agent)] or sim.agents
        ends = [self._ended_at.get((agent.id, agent.episode)) for agent in players]
        return max((sim.world.time if end is None else end) for end in ends)
