"""Readings, actions and rewards as HTML for the panel. Names from the scene are escaped."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.block_info import ActuatorInfo
from ai4u_edu.snapshot.numbers import amount, number
from ai4u_edu.viewer.panel.bars import bars
from ai4u_edu.viewer.panel.html_parts import heading, section, table

MAX_LISTED_NUMBERS = 8
"""Longest array whose numbers are listed; longer ones are drawn as bars."""
MAX_ROWS, MAX_COLUMNS, MAX_TABLES = 16, 40, 16
"""Most rows, columns and tables of bars that are drawn of an array."""
MAX_TEXT_CHARS = 200
BAR_CHARS = "▁▂▃▄▅▆▇█"


def action(numbers: Mapping[str, Sequence[float]], controls: Iterable[ActuatorInfo] = ()) -> str:
    """Return an agent's action, with the names of its components.

    Args:
        numbers: the action, by name.
        controls: descriptions of the actuators.
    """
    known = {control.name: control for control in controls}
    parts = [
        f"{_named(name, known.get(name))}{_components(values, known.get(name))}"
        for name, values in numbers.items()
    ]
    return section(heading("Action"), *(parts or ["<small>nothing yet</small>"]))


def rewards(now: Mapping[str, float], so_far: Mapping[str, float]) -> str:
    """Return a table of rewards by term: of this decision, and of the episode so far."""
    names = dict.fromkeys([*so_far, *now])
    rows = [
        (escape(name), amount(now.get(name, 0.0)), amount(so_far.get(name, 0.0))) for name in names
    ]
    head = ("", "<small>decision</small>", "<small>episode</small>")
    total = ("sum", amount(sum(now.values(), 0.0)), amount(sum(so_far.values(), 0.0)))
    return section(heading("Reward"), table([head, *rows, total]))


def reading(value: Any) -> str:
    """Return one reading as HTML, in a line or as bars."""
    if isinstance(value, str):
        return escape(value[:MAX_TEXT_CHARS])
    if isinstance(value, tuple):
        return escape(", ".join(value)[:MAX_TEXT_CHARS])
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    array = np.asarray(value)
    if array.dtype == np.bool_:
        array = array.astype(np.int64)
    if array.size <= MAX_LISTED_NUMBERS:
        return "&ensp;".join(number(each) for each in array.ravel().tolist())
    return _bars(array)


def _named(name: str, control: ActuatorInfo | None) -> str:
    block_name = f" {escape(control.block)}" if control is not None else ""
    return f"<div>{escape(name)}<small>{block_name}</small></div>"


def _components(values: Sequence[float], control: ActuatorInfo | None) -> str:
    if control is None or len(control.components) != len(values):
        return "&ensp;".join(number(value) for value in values)
    if control.is_choice:
        ((_, low, high),) = control.components
        return f"choice <b>{values[0]:.0f}</b> <small>of {low:.0f} to {high:.0f}</small>"
    return bars(
        (each.name or str(index), value, each.low, each.high, "")
        for index, (each, value) in enumerate(zip(control.components, values, strict=True))
    )


def _bars(array: npt.NDArray[Any]) -> str:
    """Draw a bar for each number: the last axis is a row, the last two are a table."""
    low, high = min(0.0, float(array.min())), max(float(array.max()), float(array.min()) + 1e-9)
    if low == 0.0 and high <= 1.0:
        high = 1.0  # most readings are normalised to 0..1, which gives all of them one scale
    steps = (array - low) / (high - low) * (len(BAR_CHARS) - 1)
    bars = np.array(list(BAR_CHARS))[np.clip(steps.round().astype(np.int64), 0, len(BAR_CHARS) - 1)]
    if array.ndim == 1:
        tables = [[bars[i : i + MAX_COLUMNS] for i in range(0, array.size, MAX_COLUMNS)]]
    else:
        tables = list(bars.reshape(-1, *array.shape[-2:]))
    shown = [[row[:MAX_COLUMNS] for row in table[:MAX_ROWS]] for table in tables[:MAX_TABLES]]
    cut = "" if sum(len(row) for table in shown for row in table) == array.size else ", in part"
    shape = " x ".join(map(str, array.shape))
    caption = f"<small>{shape}{cut}, {number(low)} to {number(high)}</small><br>"
    texts = ["\n".join("".join(row) for row in table) for table in shown]
    return caption + "".join(f"<pre>{text}</pre>" for text in texts)
