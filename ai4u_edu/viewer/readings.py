"""Readings, actions and rewards as HTML for the panel; whatever a scene can name is escaped."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import Legend
from ai4u_edu.look import Rgb
from ai4u_edu.viewer.pictures import pictures

IN_FULL = 8
"""Arrays of at most so many numbers are shown in full; longer ones as bars."""
MOST_ROWS, MOST_COLUMNS, MOST_TABLES = 16, 40, 16
LONGEST_TEXT = 200
BARS = "▁▂▃▄▅▆▇█"


def block(*parts: str) -> str:
    """Pieces of HTML as one part of the panel."""
    return f'<div class="ai4u">{"".join(parts)}</div>'


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


def readings(
    percept: Mapping[str, Any],
    legends: Mapping[str, Legend] = MappingProxyType({}),
    colours: Mapping[str, Rgb] = MappingProxyType({}),
) -> str:
    """What an agent senses, by perception key.

    Args:
        percept: what it senses.
        legends: of the readings that are pictures.
        colours: of the groups in those.
    """
    rows = [
        f"<tr>{_picture(key, value, legends[key], colours)}</tr>"
        if key in legends
        else f"<tr>{_cells(key, value)}</tr>"
        for key, value in percept.items()
    ]
    return block(heading("Senses"), f"<table>{''.join(rows)}</table>")


def action(numbers: Mapping[str, Sequence[float]]) -> str:
    """What an agent does: the components of each action by number."""
    rows = [
        (
            escape(name),
            "&ensp;".join(f"<small>{i}</small> {number(value)}" for i, value in enumerate(values)),
        )
        for name, values in numbers.items()
    ]
    return block(heading("Action"), table(rows) if rows else "<small>nothing yet</small>")


def rewards(now: Mapping[str, float], so_far: Mapping[str, float]) -> str:
    """What an agent got by term: in this decision and in this episode so far."""
    names = dict.fromkeys([*so_far, *now])
    rows = [
        (escape(name), number(now.get(name, 0.0)), number(so_far.get(name, 0.0))) for name in names
    ]
    head = ("", "<small>this decision</small>", "<small>episode</small>")
    total = ("sum", number(sum(now.values())), number(sum(so_far.values())))
    return block(heading("Reward"), table([head, *rows, total]))


def reading(value: Any) -> str:
    """One reading as HTML, in a line or as bars."""
    if isinstance(value, str):
        return escape(value[:LONGEST_TEXT])
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    array = np.asarray(value)
    if array.dtype == np.bool_:
        array = array.astype(np.int64)
    if array.size <= IN_FULL:
        return "&ensp;".join(number(each) for each in array.ravel().tolist())
    return _bars(array)


def number(value: float) -> str:
    """A number as it stands in the panel.

    >>> [number(x) for x in (0.5, -0.25, 12.3456, 1234.5, 3, -0.0001, 1e9)]
    ['0.50', '-0.25', '12.35', '1234', '3', '0.00', '1.00e+09']
    """
    if isinstance(value, int):
        return str(value)
    size = abs(value)
    text = f"{value:.2f}" if size < 1000 else f"{value:.0f}" if size < 1e6 else f"{value:.2e}"
    return "0.00" if text == "-0.00" else text


def _cells(key: str, value: Any) -> str:
    name = escape(key)
    if np.ndim(value) and np.size(value) > IN_FULL:
        return f'<th colspan="2">{name} {reading(value)}</th>'
    return f"<th>{name}</th><td>{reading(value)}</td>"


def _picture(key: str, value: Any, legend: Legend, colours: Mapping[str, Rgb]) -> str:
    shape = " x ".join(map(str, np.shape(value)))
    name = f"{escape(key)} <small>{shape}</small><br>"
    return f'<th colspan="2">{name}{pictures(value, legend, colours)}</th>'


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
