"""Rasterization of many discs and convex polygons at once.

Coordinates are in cells: u to the right, v down, the centre of the first cell at (0, 0). A convex
shape covers one span of cells in each row, so only the two ends of each span are computed; a table
gives the cells in between as bits.
"""

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Bits = npt.NDArray[np.uint8]
Spans = tuple[Floats, Floats]
"""(shapes, rows): the first and the last u of each row; no cells if the last is the smaller."""

EDGE_TOLERANCE_CELLS = 1e-9
"""A cell's centre this close to a shape's edge (in cells) belongs to the shape."""

MIN_SLOPE = EDGE_TOLERANCE_CELLS * EDGE_TOLERANCE_CELLS
"""Smallest slope that a horizontal edge is given, so that nothing divides by zero."""


class Raster:
    """Fills shapes on a grid of cells; a cell belongs to a shape if its centre does.

    Args:
        width: columns.
        height: rows.

    >>> raster = Raster(5, 3)
    >>> pictures = raster.fill(*raster.discs(np.array([[2.0, 1.0, 1.0]])))
    >>> raster.cells(pictures).astype(int)[0]
    array([[0, 0, 1, 0, 0],
           [0, 1, 1, 1, 0],
           [0, 0, 1, 0, 0]])
    """

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self._rows = np.arange(height, dtype=np.float64)
        # the first n cells of a row, as bits; the xor of two such rows is the span between them
        self._first = np.packbits(np.tri(width + 1, width, -1, dtype=np.bool_), axis=1)

    def empty(self, count: int) -> Bits:
        """Return ``count`` empty pictures."""
        return np.zeros((count, self.height, self._first.shape[1]), np.uint8)

    def discs(self, discs: Floats) -> Spans:
        """Return the span of each disc (u, v, radius) in each row."""
        u, v, radius = discs.T[:, :, None]
        square = radius * radius - (self._rows - v) ** 2 + EDGE_TOLERANCE_CELLS
        half = np.sqrt(np.maximum(square, 0.0))
        half[square < 0.0] = -1.0  # the span ends before it begins: no cells
        return u - half, u + half

    def polygons(self, edges: Floats) -> Spans:
        """Return the span of each convex polygon in each row.

        Args:
            edges: (polygons, edges, 3): a, b and c of each edge; inside is a u + b v <= c for all.
        """
        a, b, c = edges[..., 0, None], edges[..., 1, None], edges[..., 2, None]
        right = a >= 0.0  # True for an edge that bounds its row on the right
        level = np.abs(a) < EDGE_TOLERANCE_CELLS
        if level.any():
            a = np.where(level, np.where(right, MIN_SLOPE, -MIN_SLOPE), a)
        end = (c + EDGE_TOLERANCE_CELLS - b * self._rows) / a
        high = np.minimum.reduce(np.where(right, end, np.inf), axis=1)
        low = np.maximum.reduce(np.where(right, -np.inf, end), axis=1)
        return low, high

    def fill(self, low: Floats, high: Floats) -> Bits:
        """Return one picture, as bits, for each shape from its spans."""
        start = self._whole(np.ceil(low - EDGE_TOLERANCE_CELLS))
        stop = np.maximum(start, self._whole(np.floor(high + (EDGE_TOLERANCE_CELLS + 1.0))))
        # take is about ten times as fast as indexing here
        bits: Bits = self._first.take(stop, axis=0) ^ self._first.take(start, axis=0)
        return bits

    def cells(self, pictures: Bits) -> Bits:
        """Unpack pictures to 0 or 1 for each cell."""
        return np.unpackbits(pictures, axis=-1, count=self.width)

    def _whole(self, ends: Floats) -> npt.NDArray[np.intp]:
        return ends.clip(0.0, self.width).astype(np.intp)
