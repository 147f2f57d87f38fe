"""Readings that are pictures, drawn as such: as SVG, which appears without a flicker."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import ChannelLegend, CodeLegend, Legend
from ai4u_edu.snapshot.theme import UNKNOWN_GROUP, VOID, Rgb

WIDEST = 224
"""Pixels of a picture's width at most."""
LARGEST_CELL = 12
"""Pixels of a cell's side at most."""
MOST_CELLS = 96
"""Along one side; of a larger picture only some rows and columns are drawn."""
SMALL_CELL = 4
"""The same of an older reading's picture."""
OLDER = 4
"""Of stacked readings so many older ones are drawn at most: the latest of them."""
SHADES = 8
GREYS: list[Rgb] = [(shade, shade, shade) for shade in range(40, 241, 200 // (SHADES - 1))]
"""From the largest number to the smallest one: what is near is dark."""

Cells = npt.NDArray[np.intp]


def pictures(reading: Any, legend: Legend, colours: Mapping[str, Rgb], stack: int = 1) -> str:
    """A reading as pictures in HTML: what is where, and for rays how far away it is.

    Args:
        reading: as it stands in the percept.
        legend: what it means.
        colours: of the groups.
        stack: so many readings are in it; older ones are drawn smaller, oldest first.
    """
    known = [
        VOID if group == "void" else colours.get(group, UNKNOWN_GROUP) for group in legend.groups
    ]
    older = [
        _svg(legend.groups_in(each), known, SMALL_CELL)
        for each in _readings(np.asarray(reading), legend, stack)[:-1][-OLDER:]
    ]
    drawn = [_svg(legend.groups_in(reading), known)]
    if isinstance(legend, CodeLegend) and legend.planes > 1:
        planes = np.asarray(reading).reshape(-1, *legend.shape)[1 - legend.planes :]
        drawn += [_svg(_shaded(plane), GREYS) for plane in planes]
    rows = [older, drawn] if older else [drawn]
    return "".join(f'<div class="row">{"".join(row)}</div>' for row in rows)


def _readings(reading: npt.NDArray[Any], legend: Legend, stack: int) -> list[npt.NDArray[Any]]:
    """The readings in a stack, oldest first."""
    # a picture with channels has the older ones' first, all others go on top of each other
    axis = reading.ndim - 1 if isinstance(legend, ChannelLegend) else 0
    flat = reading if isinstance(legend, ChannelLegend) else reading.reshape(stack, -1)
    return np.split(flat, stack, axis=axis)


def _shaded(distances: npt.NDArray[Any]) -> Cells:
    """The number of each cell's grey, from 1; 0 where there is no distance."""
    share = distances / max(float(distances.max()), 1e-9)
    shades: Cells = 1 + np.minimum(share * SHADES, SHADES - 1).astype(np.intp)
    return np.where(distances > 0, shades, 0)


def _svg(cells: Cells, colours: Sequence[Rgb], largest: int = LARGEST_CELL) -> str:
    """Cells in the colours that they count from 1; 0 stays free."""
    step = -(-max(cells.shape) // MOST_CELLS)
    cells = cells[::step, ::step]
    rows, columns = cells.shape
    side = max(1, min(largest, WIDEST // columns))
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
    """The cells of a mask as a path, a rectangle for each run in a row."""
    edges = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, starts = np.nonzero(edges == 1)
    ends = np.nonzero(edges == -1)[1]
    runs = zip(rows.tolist(), starts.tolist(), (ends - starts).tolist(), strict=True)
    return "".join(f"M{x} {y}h{width}v1h-{width}z" for y, x, width in runs)
