"""A grid of square cells over the world."""

import math
from typing import Annotated

import numpy as np
import numpy.typing as npt
from pydantic import Field

from ai4u_edu.base.parameters import Point, PositiveMetres
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.blocks.sensors.footprint import footprint
from ai4u_edu.world import BodyView, Region

Cell = tuple[int, int]
"""(row, column); row 0 is on top, column 0 on the left."""
Cells = npt.NDArray[np.intp]
"""Indices of cells, row by row: row * columns + column."""
Length = Annotated[int, Field(ge=1, le=512)]

EDGE_TOLERANCE_M = 1e-9
"""A cell's centre this close to a shape's edge (metres) belongs to the shape."""


class OnGrid(Parameterized):
    """The parameters of blocks that see the world as a grid; equal parameters give equal cells."""

    rows: Length = 20
    """Rows of the grid."""
    columns: Length = 20
    """Columns of the grid."""
    cell_size: PositiveMetres = 1.0
    """Side length of a cell."""
    centre: Point = (0.0, 0.0)
    """Middle of the whole grid in the world: (x, y), in metres."""

    def grid(self) -> "Grid":
        """Return the grid that these parameters describe."""
        return Grid(self.rows, self.columns, self.cell_size, self.centre)


class Grid:
    """Rows and columns of cells, north up: row 0 is on top (+y), column 0 on the left (-x).

    Args:
        rows: number of rows.
        columns: number of columns.
        cell_size: side length of a cell, metres.
        centre: centre of the grid, world frame, metres.

    >>> grid = Grid(20, 20, 1.0, (0.0, 0.0))
    >>> grid.cell_at(-9.6, 9.9), grid.centre_of((0, 0))
    ((0, 0), (-9.5, 9.5))
    """

    def __init__(self, rows: int, columns: int, cell_size: float, centre: Point) -> None:
        self.rows, self.columns, self.cell_size = rows, columns, cell_size
        self._left = centre[0] - columns * cell_size / 2
        self._top = centre[1] + rows * cell_size / 2
        row, column = np.divmod(np.arange(rows * columns), columns)
        self._x = self._left + (column + 0.5) * cell_size
        self._y = self._top - (row + 0.5) * cell_size
        self._cache: dict[BodyView, tuple[object, Cells]] = {}

    def cell_at(self, x: float, y: float) -> Cell:
        """Return the cell that contains a point; outside the grid the numbers continue."""
        column = math.floor((x - self._left) / self.cell_size)
        return math.floor((self._top - y) / self.cell_size), column

    def centre_of(self, cell: Cell) -> Point:
        """Return the centre of a cell, world frame, metres."""
        row, column = cell
        return (
            self._left + (column + 0.5) * self.cell_size,
            self._top - (row + 0.5) * self.cell_size,
        )

    def holds(self, cell: Cell) -> bool:
        """Return True if a cell is on the grid."""
        return 0 <= cell[0] < self.rows and 0 <= cell[1] < self.columns

    def number(self, cell: Cell) -> int:
        """Return a cell's index, row by row."""
        return cell[0] * self.columns + cell[1]

    def cells_of(self, body: BodyView) -> Cells:
        """Return the cells whose centre a body covers; if it covers none, the cell of its centre.

        A body thinner than a cell counts as one cell thick, so that no wall has gaps.
        """
        where = body.pose, body.sampled
        cached = self._cache.get(body)
        if cached is None or cached[0] != where:
            cached = self._cache[body] = where, self._covered(body)
        return cached[1]

    def cells_in(self, region: Region) -> Cells:
        """Return the cells whose centre lies in a floor or an area."""
        return np.flatnonzero(region.contains_each(self._x, self._y))

    def _covered(self, body: BodyView) -> Cells:
        (x, y, _, heading), shape = body.pose, body.sampled.shape
        cos, sin = math.cos(heading), math.sin(heading)
        dx, dy = self._x - x, self._y - y
        u, v = cos * dx + sin * dy, cos * dy - sin * dx
        parts = footprint(shape, self.cell_size)
        inside = np.zeros(len(u), np.bool_)
        for mid_u, mid_v, radius in parts.discs:
            inside |= np.hypot(u - mid_u, v - mid_v) <= radius + EDGE_TOLERANCE_M
        for edges in parts.polygons:
            inside |= np.all([a * u + b * v <= c + EDGE_TOLERANCE_M for a, b, c in edges], axis=0)
        if not inside.any():
            mid_u, mid_v = np.mean(shape.outline(), axis=0).tolist()
            cell = self.cell_at(x + cos * mid_u - sin * mid_v, y + sin * mid_u + cos * mid_v)
            return np.array([self.number(cell)] if self.holds(cell) else [], np.intp)
        return np.flatnonzero(inside)
