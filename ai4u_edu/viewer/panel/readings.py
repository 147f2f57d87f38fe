"""Readings, actions and rewards as HTML for the panel; whatever a scene can name is escaped."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.block_info import ActuatorInfo
from ai4u_edu.viewer.panel.bars import amount, bars, number

IN_FULL = 8
"""Arrays of at most so many numbers are shown in full; longer ones as bars."""
MOST_ROWS, MOST_COLUMNS, MOST_TABLES = 16, 40, 16
LONGEST_TEXT = 200
BARS = "▁▂▃▄▅▆▇█"


def block(*parts: str, kind: str = "") -> str:
    """Pieces of HTML as one part of the panel."""
    return f'<div class="ai4u{f" {kind}" if kind else ""}">{"".join(parts)}</div>'


def heading(text: str) -> str:
    """A heading above a table."""
    return f"<p>{escape(text)}</p>"


def table(rows: Iterable[Sequence[str]]) -> str:
    """Rows of HTML cells; each row's first cell is a name."""
    lines = [
        f"<tr><th>{name}</th>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"
        for name, *cells in rows
    ]
    return f"<table>{''.join(lines)}</table>"


def action(numbers: Mapping[str, Sequence[float]], controls: Iterable[ActuatorInfo] = ()) -> str:
    """What an agent does, each component by its name.

    Args:
        numbers: the action.
        controls: what is known of it beforehand.
    """
    known = {control.name: control for control in controls}
    parts = [
        f"{_named(name, known.get(name))}{_components(values, known.get(name))}"
        for name, values in numbers.items()
    ]
    return block(heading("Action"), *(parts or ["<small>nothing yet</small>"]))


def rewards(now: Mapping[str, float], so_far: Mapping[str, float]) -> str:
    """What an agent got by term: in this decision and in this episode so far."""
    names = dict.fromkeys([*so_far, *now])
    rows = [
        (escape(name), amount(now.get(name, 0.0)), amount(so_far.get(name, 0.0))) for name in names
    ]
    head = ("", "<small>decision</small>", "<small>episode</small>")
    total = ("sum", amount(sum(now.values(), 0.0)), amount(sum(so_far.values(), 0.0)))
    return block(heading("Reward"), table([head, *rows, total]))


def reading(value: Any) -> str:
    """One reading as HTML, in a line or as bars."""
    if isinstance(value, str):
        return escape(value[:LONGEST_TEXT])
    if isinstance(value, tuple):
        return escape(", ".join(value)[:LONGEST_TEXT])
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    array = np.asarray(value)
    if array.dtype == np.bool_:
        array = array.astype(np.int64)
    if array.size <= IN_FULL:
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
    """A bar for each number: rows as the last axis runs, tables as the last two run."""
    low, high = min(0.0, float(array.min())), max(float(array.max()), float(array.min()) + 1e-9)
    if low == 0.0 and high <= 1.0:
        high = 1.0  # most readings are normalised: so their bars mean the same at any time
    steps = (array - low) / (high - low) * (len(BARS) - 1)
    bars = np.array(list(BARS))[np.clip(steps.round().astype(np.int64), 0, len(BARS) - 1)]
    if array.ndim == 1:
        tables = [[bars[i : i + MOST_COLUMNS] for i in range(0, array.size, MOST_COLUMNS)]]
    else:
        tables = list(bars.reshape(-1, *array.shape[-2:]))
    shown = [[row[:MOST_COLUMNS] for row in table[:MOST_ROWS]] for table in tables[:MOST_TABLES]]
    cut = "" if sum(len(row) for table in shown for row in table) == array.size else ", in part"
    shape = " x ".join(map(str, array.shape))
    caption = f"<small>{shape}{cut}, {number(low)} to {number(high)}</small><br>"
    texts = ["\n".join("".join(row) for row in table) for table in shown]
    return caption + "".join(f"<pre>{text}</pre>" for text in texts)
