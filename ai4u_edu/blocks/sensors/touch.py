"""Contact sensors for one body or area."""

from typing import ClassVar, Literal

from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView


class TouchSensor(Sensor):
    """+1 while the agent touches the target, else -1: a bumper for one target.

    The target is a body, or an area (which the agent touches with its centre). It reads the present
    contacts: a touch that began and ended between two decisions is missed. A reset clears it; a
    touch from the start is read after the first tick.

    Reading: (1,), -1 or 1. Source: AI4U's TouchSensor, whose contacts outlive a reset.
    """

    target: str
    """Name of the body or area."""

    def space(self) -> Box:
        """Return the range -1..1."""
        return Box(-1.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        view.check_target(self.target)

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        return 1.0 if view.touching(body, self.target) else -1.0


class EventSensor(Sensor):
    """1 once, when the agent has come to touch the target or has left it, else 0.

    A TouchSensor says what is so now; this one says what has happened since the last reading, so
    that a program or a script reacts to it once. The target is a body, or an area, in which the
    agent is if its centre is. What began and ended between two decisions counts, too. An area in
    which an episode begins was not entered.

    Reading: (1,), 0 or 1. Source: ours; AI4U's scenes do it with the signals OnTouch, body_entered
    and body_exited.
    """

    event: Literal["touch", "leave"] = "touch"
    """Event that is read: touch, which is to enter if the target is an area; or leave."""
    target: str
    """Name of the body or area."""

    carried: ClassVar[tuple[str, ...]] = ("_was_there", "_since", "_has_begun", "_has_ended")

    def __post_init__(self) -> None:
        super().__post_init__()
        self._is_area = False
        self._was_there: bool | None = None
        """None before the first look at an area."""
        self._since = 0
        self._has_begun = self._has_ended = False
        """True if a touch or a stay has begun, and has ended, since the last reading."""

    def space(self) -> Box:
        """Return the range 0..1."""
        return Box(0.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        view.check_target(self.target)
        self._is_area = self.target in view.areas

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget past events."""
        self._was_there = None if self.target in view.areas else False
        self._since = view.ticks
        self._has_begun = self._has_ended = False

    @property
    def has_ticks(self) -> bool:
        """True for an area; contacts with bodies are kept by the world."""
        return self._is_area

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Note an area that was entered or left in this tick."""
        self._look(body, view)

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the reading."""
        self._look(body, view)
        happened = self._has_begun if self.event == "touch" else self._has_ended
        self._has_begun = self._has_ended = False
        return float(happened)

    def _look(self, body: BodyView, view: WorldView) -> None:
        is_there = view.touching(body, self.target)
        was_there = is_there if self._was_there is None else self._was_there
        began = not was_there and view.touched_after(body, self.target, self._since)
        self._has_begun = self._has_begun or began
        self._has_ended = self._has_ended or (not is_there and (was_there or began))
        self._was_there, self._since = is_there, view.ticks
