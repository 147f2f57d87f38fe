"""Brains made from controllers and functions."""

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Brain, Controller, LocalBrain
from ai4u_edu.blocks.parameterized import Parameterized


def as_brain(given: object) -> Brain:
    """Return a brain unchanged, or a LocalBrain for a controller or a function.

    Raises:
        SetupError: the value is none of these.
    """
    if isinstance(given, Brain):
        return given
    if can_drive(given):
        return LocalBrain(controller=given)  # type: ignore[arg-type]  # can_drive checked it
    problem = f"the class {given.__name__}" if isinstance(given, type) else repr(given)
    raise SetupError(
        f"expected a brain, a controller or a function from percept to action, got {problem}; "
        "a brain is made as in LocalBrain(controller=WASDRBMoveController())"
    )


def can_drive(given: object) -> bool:
    """Return True for a controller or a function, which a LocalBrain can hold."""
    if isinstance(given, Controller):
        return True
    return callable(given) and not isinstance(given, type | Parameterized)
