"""Events of an agent and the handlers connected to them."""

from collections.abc import Callable
from typing import Any, Generic, TypeVar, TypeVarTuple

from ai4u_edu.agent.error_context import HasId, add_context
from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

A = TypeVar("A", bound=HasId)
"""The class of agents that a handler gets."""
Details = TypeVarTuple("Details")
"""The arguments that a handler gets after the agent; most events have none."""

EVENTS = (
    "agent_start",
    "before_the_reset",
    "begin_of_episode",
    "begin_of_update_state",
    "end_of_update_state",
    "begin_of_step",
    "begin_of_apply_action",
    "end_of_apply_action",
    "end_of_step",
    "end_of_episode",
)
"""AI4U's events, by the names that AI4U's guide gives them (``agent_start`` came later)."""

CONTACT_EVENTS = ("touched", "area_entered", "area_left")
"""Our names for AI4U's OnTouch, and for Godot's body_entered and body_exited of an area."""


class Event(Generic[A, *Details]):
    """An event; it calls its handlers with the agent, in the order of connection.

    Handlers of :data:`CONTACT_EVENTS` also get the name of a body or an area.

    >>> event = Event("end_of_step")
    >>> @event.connect
    ... def note_end(agent):
    ...     print("a step ended")
    >>> event.fire(None)
    a step ended
    >>> event.disconnect(note_end)
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.handlers: list[Callable[[A, *Details], None]] = []
        """Connected handlers; callers test it before :meth:`fire`, since most events have none."""

    def connect(self, handler: Callable[[A, *Details], None]) -> Callable[[A, *Details], None]:
        """Call the handler at this event from now on; also a decorator.

        Raises:
            SetupError: it is no function.
        """
        if not callable(handler):
            raise SetupError(
                _(
                    "connect: expected a function that gets the agent, got {handler}; give a "
                    "function that is called later, as in connect(lambda agent: print(agent.id))",
                    handler=repr(handler),
                )
            )
        self.handlers.append(handler)
        return handler

    def disconnect(self, handler: Callable[[A, *Details], None]) -> None:
        """Stop calling the handler."""
        self.handlers.remove(handler)

    def fire(self, agent: A, *details: *Details) -> None:
        """Call all handlers; an error of a handler names the handler, the event and the agent."""
        handler: Callable[[A, *Details], None] | None = None
        try:
            for handler in tuple(self.handlers):
                handler(agent, *details)
        except Exception as error:
            title = getattr(handler, "__qualname__", type(handler).__name__)
            title = title.rpartition("<locals>.")[2]
            handler_of = _("handler {name} of {event}", name=title, event=self.name)
            add_context(error, agent, handler_of, _("while {block} of {agent} was called"))
            raise

    def __repr__(self) -> str:
        return f"<Event {self.name}, {len(self.handlers)} handlers>"


class ContactEvents(Generic[A]):
    """The events of an agent's body with other bodies and areas, fired after a tick.

    They are fired only while the agent's decision is under way, after each tick: touches first, in
    the order in which they began, then areas left and areas entered, in the world's order. A body
    is in an area if its centre is. Handlers that are connected within a decision count from the
    next one on. An area in which the first tick of an episode finds the body was not entered.
    """

    def __init__(self) -> None:
        self.touched: Event[A, str] = Event("touched")
        self.area_entered: Event[A, str] = Event("area_entered")
        self.area_left: Event[A, str] = Event("area_left")
        self._touching: tuple[str, ...] = ()
        self._inside: tuple[str, ...] | None = None

    @property
    def has_handlers(self) -> bool:
        """True if a handler is connected; else nothing has to be looked up at each tick."""
        return bool(self.touched.handlers or self.area_entered.handlers or self.area_left.handlers)

    def begin(self) -> None:
        """Begin an episode: nothing is touched, and no area known."""
        self._touching, self._inside = (), None

    def fire(self, agent: A, body: BodyView, view: WorldView) -> None:
        """Compare with the tick before, and call the handlers."""
        before, self._touching = self._touching, view.contacts(body)
        was_inside = self._inside
        place = body.position
        self._inside = tuple(name for name, area in view.areas.items() if area.contains(*place))
        inside = self._inside
        for name in self._touching:
            if name not in before:
                self.touched.fire(agent, name)
        if was_inside is None or was_inside == inside:
            return
        for name in was_inside:
            if name not in inside:
                self.area_left.fire(agent, name)
        for name in inside:
            if name not in was_inside:
                self.area_entered.fire(agent, name)

    def get_state(self) -> tuple[Any, ...]:
        """Return what is touched, and the areas that the body is in."""
        return self._touching, self._inside

    def set_state(self, state: tuple[Any, ...]) -> None:
        """Go on from the state of the same agent in another copy of its world."""
        self._touching, self._inside = state
