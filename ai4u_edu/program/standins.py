"""The part of ai4u_edu that a program finds in the page."""

import copy
from collections.abc import Mapping
from types import ModuleType
from typing import Any

from ai4u_edu.program.texts import gettext as _

Percept = Mapping[str, Any]
"""Readings by perception key, for annotations."""


class Controller:
    """Base of a program's controllers: override :meth:`get_action`.

    Annotated fields are parameters, as those of the real Controller; their types are not checked.

    >>> class Forward(Controller):
    ...     speed: float = 1.0
    ...     def get_action(self, percept): return {"move": [self.speed, 0, 0, 0]}
    >>> Forward(speed=0.5).get_action({})
    {'move': [0.5, 0, 0, 0]}
    """

    def __init__(self, **parameters: Any) -> None:
        fields = [
            name
            for cls in reversed(type(self).__mro__)
            for name in getattr(cls, "__annotations__", ())
        ]
        for name in parameters.keys() - set(fields):
            raise TypeError(
                _("{type} has no parameter {name!r}", type=type(self).__name__, name=name)
            )
        for name in fields:
            if name in parameters or hasattr(self, name):
                # a list among the defaults is nobody else's
                setattr(self, name, parameters.get(name, copy.copy(getattr(self, name, None))))
        self.__post_init__()

    def __post_init__(self) -> None:
        """Prepare what the parameters define."""

    def on_setup(self, agent: Any, view: Any) -> None:
        """Prepare for the first episode."""

    def on_reset(self, agent: Any, view: Any) -> None:
        """Forget what belongs to the last episode."""

    def new_state_event(self, percept: Percept) -> None:
        """React to a new percept; called before :meth:`get_action`."""

    def get_action(self, percept: Percept) -> Any:
        """Return an action for each actuator, by its name."""
        raise NotImplementedError(
            _(
                "{type} has no get_action(self, percept): it must return an action",
                type=type(self).__name__,
            )
        )


NAMES = ("Controller", "Percept")
"""Names that a program can import from ai4u_edu."""

MODULE = ModuleType("ai4u_edu", "The part of ai4u_edu that a program finds in the page.")
for _name in NAMES:
    setattr(MODULE, _name, globals()[_name])
