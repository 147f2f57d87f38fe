"""Discs and convex polygons as rows of cells, many at once.

Coordinates are in cells: u to the right, v down, the centre of the first cell at (0, 0). A shape
covers, in each row, the cells from one column to another, since it is convex; so only the two ends
of each row are worked out, and a table gives the cells in between as bits.
"""

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Bits = npt.NDArray[np.uint8]
Spans = tuple[Floats, Floats]
"""(shapes, rows): the first and the last u of each row; no cells where the last is the smaller."""

RIM = 1e-9
"""A centre this close to a rim (in cells) lies on it, and belongs to the shape."""


class Raster:
    """Draws on a grid of cells; a cell belongs to a shape if its centre does.

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
        # the first n cells of a row, as bits; two such rows differ in the cells between their ends
        self._first = np.packbits(np.tri(width + 1, width, -1, dtype=np.bool_), axis=1)

    def nothing(self, count: int) -> Bits:
        """``count`` empty pictures."""
        return np.zeros((count, self.height, self._first.shape[1]), np.uint8)

    def discs(self, discs: Floats) -> Spans:
        """Where each disc (u, v, radius) begins and ends in each row."""
        u, v, radius = discs.T[:, :, None]
        square = radius * radius - (self._rows - v) ** 2 + RIM
        half = np.sqrt(np.maximum(square, 0.0))
        half[square < 0.0] = -1.0  # an end before the beginning: no cells
        return u - half, u + half

    def polygons(self, edges: Floats) -> Spans:
        """Where each convex polygon begins and ends in each row.

        Args:
            edges: (polygons, edges, 3): a, b and c of each; inside is a u + b v <= c for all.
        """
        a, b, c = edges[..., 0, None], edges[..., 1, None], edges[..., 2, None]
        right = a >= 0.0  # whether an edge bounds its row on the right
        level = np.abs(a) < RIM
        if level.any():
            a = np.where(level, np.where(right, RIM * RIM, -RIM * RIM), a)
        end = (c + RIM - b * self._rows) / a
        high = np.minimum.reduce(np.where(right, end, np.inf), axis=1)
        low = np.maximum.reduce(np.where(right, -np.inf, end), axis=1)
        return low, high

    def fill(self, low: Floats, high: Floats) -> Bits:
        """One picture, as bits, for each shape from where its rows begin and end."""
        start = self._whole(np.ceil(low - RIM))
        stop = np.maximum(start, self._whole(np.floor(high + (RIM + 1.0))))
        # take is ten times as fast as an index here
        bits: Bits = self._first.take(stop, axis=0) ^ self._first.take(start, axis=0)
        return bits

    def cells(self, pictures: Bits) -> Bits:
        """Pictures cell by cell: 0 or 1."""
        return np.unpackbits(pictures, axis=-1, count=self.width)

    def _whole(self, ends: Floats) -> npt.NDArray[np.intp]:
        return ends.clip(0.0, self.width).astype(np.intp)
