"""Readings that are pictures, as SVG, which the page updates without flicker."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import CodeLegend, Legend
from ai4u_edu.snapshot.reading_cells import GREYS, Cells, shaded, split_stack
from ai4u_edu.snapshot.theme import UNKNOWN_GROUP, VOID, Rgb

MAX_PICTURE_WIDTH_PX = 224
MAX_CELL_PX = 12
"""Largest side of a cell."""
MAX_OLDER_CELL_PX = 4
"""Largest side of a cell in the picture of an older reading."""
MAX_CELLS_PER_SIDE = 96
"""Most rows or columns; of a larger picture only every second, third, ... one is drawn."""
MAX_OLDER_READINGS = 4
"""Most older readings of a stack that are drawn: the latest ones."""


def pictures(reading: Any, legend: Legend, colours: Mapping[str, Rgb], stack: int = 1) -> str:
    """Return a reading as pictures: the groups in its cells and, for rays, the distances.

    Args:
        reading: the reading in the percept.
        legend: the meaning of its numbers.
        colours: colours by group.
        stack: number of stacked readings; older ones are drawn smaller, oldest first.
    """
    known = [
        VOID if group == "void" else colours.get(group, UNKNOWN_GROUP) for group in legend.groups
    ]
    older = [
        _svg(legend.groups_in(each), known, MAX_OLDER_CELL_PX)
        for each in split_stack(np.asarray(reading), legend, stack)[:-1][-MAX_OLDER_READINGS:]
    ]
    drawn = [_svg(legend.groups_in(reading), known)]
    if isinstance(legend, CodeLegend) and legend.planes > 1:
        planes = np.asarray(reading).reshape(-1, *legend.shape)[1 - legend.planes :]
        drawn += [_svg(shaded(plane), GREYS) for plane in planes]
    rows = [older, drawn] if older else [drawn]
    return "".join(f'<div class="row">{"".join(row)}</div>' for row in rows)


def _svg(cells: Cells, colours: Sequence[Rgb], largest: int = MAX_CELL_PX) -> str:
    """Draw cells as SVG. A cell is an index of a colour, counted from 1; 0 stays empty."""
    step = -(-max(cells.shape) // MAX_CELLS_PER_SIDE)
    cells = cells[::step, ::step]
    rows, columns = cells.shape
    side = max(1, min(largest, MAX_PICTURE_WIDTH_PX // columns))
    paths = [
        f'<path fill="rgb{colour}" d="{_runs(cells == number)}"/>'
        for number, colour in enumerate(colours, start=1)
        if (cells == number).any()
    ]
    return (
        f'<svg viewBox="0 0 {columns} {rows}" width="{side * columns}" height="{side * rows}"'
        f' shape-rendering="crispEdges">{"".join(paths)}</svg>'
    )


def _runs(mask: npt.NDArray[np.bool_]) -> str:
    """Return a mask's cells as an SVG path with a rectangle for each run in a row."""
    edges = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, starts = np.nonzero(edges == 1)
    ends = np.nonzero(edges == -1)[1]
    runs = zip(rows.tolist(), starts.tolist(), (ends - starts).tolist(), strict=True)
    return "".join(f"M{x} {y}h{width}v1h-{width}z" for y, x, width in runs)
