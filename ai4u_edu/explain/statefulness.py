"""Signs that a controller decides by more than the percept."""

from collections.abc import Iterator
from contextlib import suppress
from types import FunctionType, MethodType, ModuleType
from typing import Any

from ai4u_edu.blocks import Controller
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _

REASONS = {
    "on_setup": _(
        "{controller} prepares itself with the world, so it may read more than the percept"
    ),
    "on_reset": _(
        "{controller} begins again at each reset, so it keeps something from one decision to the "
        "next"
    ),
    "new_state_event": _(
        "{controller} follows the percepts as they come, so it keeps something of earlier ones"
    ),
}
"""Patterns of reasons by the method that a controller overrides."""


def dependence_on_more(controller: Controller) -> str:
    """Return why a controller's action may depend on more than the percept; empty if it doesn't.

    >>> from ai4u_edu import ArrowController
    >>> dependence_on_more(ArrowController())[:40]
    'ArrowController prepares itself with the'
    """
    kind = type(controller)
    reason = dependence_of(kind)
    if not reason:
        return ""
    return _("{reason}; an explanation by leaving out readings does not apply to it", reason=reason)


def dependence_of(kind: type[Controller]) -> str:
    """Return why the actions of a class of controllers may depend on more than the percept.

    Returns:
        A clause that begins with the class; empty if they don't.
    """
    for method, reason in REASONS.items():
        if getattr(kind, method) is not getattr(Controller, method):
            return Text(reason, {"controller": kind.__name__})
    return ""


def memory_of(owner: Any) -> dict[str, str]:
    """Return a description of what a policy may remember, by name, to be compared later.

    For an object these are its attributes, for a function its closure and the variables that it
    reads from its module. Changes deep inside large arrays may go unnoticed.
    """
    if isinstance(owner, MethodType):
        return memory_of(owner.__self__) | memory_of(owner.__func__)
    if isinstance(owner, FunctionType):
        return {name: repr(value) for name, value in _variables(owner)}
    return {name: repr(value) for name, value in getattr(owner, "__dict__", {}).items()}


def _variables(function: FunctionType) -> Iterator[tuple[str, Any]]:
    """Yield a function's own attributes, and the variables from outside that it reads."""
    yield from vars(function).items()
    for name in function.__code__.co_names:
        value = function.__globals__.get(name)
        if not isinstance(value, type | ModuleType | FunctionType):
            yield name, value
    names = function.__code__.co_freevars
    for name, cell in zip(names, function.__closure__ or (), strict=True):
        with suppress(ValueError):  # not filled yet
            yield name, cell.cell_contents
