"""Check of a program's decision: names of actuators, and numbers for each."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ai4u_edu.program.mistakes import NOTHING_RETURNED, ProgramError
from ai4u_edu.program.reading import Reading
from ai4u_edu.program.words import nearest, shown, suggest

DIGITS = 9
"""Digits behind the point to which a decision's numbers are rounded. Functions such as sin and
atan2 differ by one unit in the last place between the page and other machines; rounded, decisions
are the same everywhere."""

Outputs = Mapping[str, tuple[Sequence[float], Sequence[float]]]
"""Lowest and highest values of each number, by the actuator's name."""


def checked_action(answer: Any, outputs: Outputs | None, line: int = 0) -> dict[str, list[float]]:
    """Return a program's answer as numbers by the actuator's name.

    Numbers out of range stay as they are: the actuator clips them.

    Args:
        answer: the value that the program returned.
        outputs: the agent's actuators; None checks neither names nor counts.
        line: of the program, that returned it.

    Raises:
        ProgramError: it is no action of this agent.

    >>> checked_action({"move": (1, 0.5)}, {"move": ([-1, -1], [1, 1])})
    {'move': [1.0, 0.5]}
    >>> checked_action({"mov": [1, 0.5]}, {"move": ([-1, -1], [1, 1])}, 3)
    Traceback (most recent call last):
    ai4u_edu.program.mistakes.ProgramError: line 3: the agent has no actuator 'mov'; did you mean \
'move'?
    """
    if answer is None:
        raise ProgramError(NOTHING_RETURNED, line, "no-return")
    if not isinstance(answer, Mapping):
        raise ProgramError(
            f"expected an action like {_example(outputs)}, got {shown(answer)}", line, "action"
        )
    return {name: _numbers(name, answer[name], outputs, line) for name in answer}


def _numbers(name: Any, value: Any, outputs: Outputs | None, line: int) -> list[float]:
    count = None
    if outputs is not None:
        if not isinstance(name, str) or name not in outputs:
            # others take no numbers, and the page does not list them
            known = [each for each, (low, _) in outputs.items() if len(low)]
            text = f"the agent has no actuator {shown(name)}; {suggest(str(name), known)}"
            if not nearest(str(name), known):
                text += f"; write, say, {_example(outputs)}"
            raise ProgramError(text, line, "actuator")
        count = len(outputs[name][0])
    wanted = "numbers" if count is None else f"{count} number{'s' * (count != 1)}"
    if hasattr(value, "tolist") and not isinstance(value, Reading):
        value = value.tolist()
    values = list(value) if isinstance(value, list | tuple | Reading) else [value]
    for each in values:
        if each is None or not isinstance(each, int | float):
            text = f"action {name!r}: expected {wanted}, got {shown(each)} in {shown(value)}"
            text += _advice(each, name, outputs)
            raise ProgramError(text, line, "not-a-number")
    if count is not None and len(values) != count:
        text = f"action {name!r}: expected {wanted}, got {len(values)}: {shown(value)}"
        text += f"; write, say, {_example(outputs, name)}"
        raise ProgramError(text, line, "length")
    try:
        numbers = [float(each) for each in values]
    except OverflowError:
        numbers = [math.inf]
    if not all(map(math.isfinite, numbers)):
        text = f"action {name!r}: expected finite numbers, got {shown(value)}"
        text += "; inf and nan come from sums and quotients without a value"
        raise ProgramError(text, line, "not-finite")
    return [round(each, DIGITS) for each in numbers]


def _advice(value: Any, name: str, outputs: Outputs | None) -> str:
    """Return how to mend a value that is no number."""
    if isinstance(value, str):
        try:
            return f"; {shown(value)} is a text: write {float(value):g} without quotes"
        except ValueError:
            return f"; {shown(value)} is a text, and a number has no quotes"
    if value is None:
        return "; None means that a function returned nothing, or that nothing was computed yet"
    return f"; write, say, {_example(outputs, name)}"


def _example(outputs: Outputs | None, name: str = "") -> str:
    numbered = {each: low for each, (low, _) in (outputs or {}).items() if len(low)}
    if not numbered:
        return '{"move": [forward, turn, 0, 0]}'
    name = name if name in numbered else next(iter(numbered))
    low = numbered[name]
    values = ", ".join(["1", *["0"] * (len(low) - 1)][: len(low)])
    return f'{{"{name}": [{values}]}}'
