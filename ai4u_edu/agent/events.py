"""Events of an agent and the handlers connected to them."""

from collections.abc import Callable
from typing import Generic, TypeVar

from ai4u_edu.agent.error_context import HasId, add_context
from ai4u_edu.base.errors import SetupError

A = TypeVar("A", bound=HasId)
"""The class of agents that a handler gets."""

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


class Event(Generic[A]):
    """An event; it calls its handlers with the agent, in the order of connection.

    >>> event = Event("end_of_step")
    >>> @event.connect
    ... def told(agent):
    ...     print("a step ended")
    >>> event.fire(None)
    a step ended
    >>> event.disconnect(told)
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.handlers: list[Callable[[A], None]] = []
        """Connected handlers; callers test it before :meth:`fire`, since most events have none."""

    def connect(self, handler: Callable[[A], None]) -> Callable[[A], None]:
        """Call the handler at this event from now on; also a decorator.

        Raises:
            SetupError: it is no function.
        """
        if not callable(handler):
            raise SetupError(
                f"connect: expected a function that gets the agent, got {handler!r}; give a "
                "function that is called later, as in connect(lambda agent: print(agent.id))"
            )
        self.handlers.append(handler)
        return handler

    def disconnect(self, handler: Callable[[A], None]) -> None:
        """Stop calling the handler."""
        self.handlers.remove(handler)

    def fire(self, agent: A) -> None:
        """Call all handlers; an error of a handler names the handler, the event and the agent."""
        handler: Callable[[A], None] | None = None
        try:
            for handler in tuple(self.handlers):
                handler(agent)
        except Exception as error:
            title = getattr(handler, "__qualname__", type(handler).__name__)
            title = title.rpartition("<locals>.")[2]
            add_context(error, agent, f"handler {title} of {self.name}", "was called")
            raise

    def __repr__(self) -> str:
        return f"<Event {self.name}, {len(self.handlers)} handlers>"
