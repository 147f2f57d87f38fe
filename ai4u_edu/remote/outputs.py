"""Checks of a script's action before it is sent."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ai4u_edu.base.errors import ActionError, shown, suggest
from ai4u_edu.wire.native import Output


def numbers_of(outputs: Mapping[str, Output], action: Any) -> dict[str, tuple[float, ...]]:
    """Return the numbers of an action by the actuator's name.

    Args:
        outputs: the actuators by name.
        action: numbers by the actuator's name; of an agent with one actuator, its numbers alone.

    Raises:
        ActionError: it names an unknown actuator, or its numbers don't fit.

    >>> move = Output("move", "box", (-1.0, -1.0), (1.0, 1.0), True)
    >>> numbers_of({"move": move}, {"move": [1, 0]})
    {'move': (1.0, 0.0)}
    >>> numbers_of({"move": move}, {"mvoe": [1, 0]})
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.ActionError: no actuator is called 'mvoe'; did you mean 'move'?
    """
    if not isinstance(action, Mapping):
        if len(outputs) != 1:
            raise ActionError(
                f"expected numbers by the actuator's name ({', '.join(outputs)}), "
                f"got {shown(action)}"
            )
        action = {next(iter(outputs)): action}
    for name in action:
        if name not in outputs:
            raise ActionError(f"no actuator is called {shown(name)}; {suggest(str(name), outputs)}")
    return {name: _numbers(outputs[name], values) for name, values in action.items()}


def _numbers(output: Output, values: Any) -> tuple[float, ...]:
    try:
        if hasattr(values, "tolist"):  # numpy's
            values = values.tolist()
        if isinstance(values, int | float):
            values = (values,)
        if isinstance(values, Sequence) and not isinstance(values, str | bytes):
            numbers = tuple(map(float, values))
            if len(numbers) == len(output.low) and all(map(math.isfinite, numbers)):
                return numbers
    except (TypeError, ValueError, OverflowError):
        pass
    count = len(output.low)
    raise ActionError(
        f"action {output.name!r}: expected {count} finite number{'s' * (count != 1)}, "
        f"got {shown(values)}"
    )
