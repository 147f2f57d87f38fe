"""Ink on the floors: what pens have drawn, as an integer raster in tiles."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple
from zlib import crc32

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.world.descriptions import FloorDescription
from ai4u_edu.world.region import Region

CELL_M = 0.05
"""Side of a cell, which has one colour."""
TILE_CELLS = 64
"""Cells of a tile along each side."""
TILE_M = CELL_M * TILE_CELLS
MAX_TILES = 1024
"""Tiles of a world, of 4 KB each: 10,000 square metres. Beyond them a pen leaves no trace."""
MAX_STROKE_M = 1.0
"""Longest stroke of one tick; what moved farther was put there, and draws no line."""
NO_INK = 0
INK_COLOURS = tuple(PALETTE)
"""Names of the colours of cells: that of code 1 comes first."""
ENDLESS = ""
"""Name of the ground of a world without floors."""
_SAME_HEIGHT_M = 1e-6

Tile = npt.NDArray[np.uint8]
Floors = Mapping[str, tuple[FloorDescription, Region]]


class TileKey(NamedTuple):
    """Place of a tile."""

    floor: str
    """Name of the floor; empty for endless ground."""
    column: int
    """Its left edge is at ``column * TILE_M``, in the world's frame."""
    row: int
    """Its lower edge is at ``row * TILE_M``."""


@dataclass(frozen=True)
class InkImage:
    """The ink of a world at one moment; never changed, so that everybody may keep it."""

    tiles: Mapping[TileKey, Tile] = field(default_factory=lambda: MappingProxyType({}))
    """Codes of cells, (row, column): 0 without ink, else 1 + the index in INK_COLOURS."""
    digest: int = 0
    """Checksum of all that was drawn since the world's reset; 0 if nothing was."""

    def __bool__(self) -> bool:
        return bool(self.tiles)


BLANK = InkImage()


def ink_code(colour: str) -> int:
    """Return the code of a colour.

    >>> ink_code("black"), ink_code("none")
    (1, 0)
    """
    return NO_INK if colour == "none" else 1 + INK_COLOURS.index(colour)


class Ink:
    """The ink of a world.

    A tile is copied before it is changed if somebody else has it: snapshots, replays and pages
    share all tiles that stay as they are. A stroke costs as much as the cells that it covers,
    however many there were before.

    Args:
        floors: description and region of each floor, by name; it may change at any time.
    """

    def __init__(self, floors: Floors) -> None:
        self._floors = floors
        self._tiles: dict[TileKey, Tile] = {}
        self._own: set[TileKey] = set()
        self._digest = 0
        self._image: InkImage | None = BLANK

    def __bool__(self) -> bool:
        return bool(self._tiles)

    def image(self) -> InkImage:
        """Return the ink as it is now; the same object until something is drawn."""
        if self._image is None:
            self._own.clear()
            self._image = InkImage(MappingProxyType(dict(self._tiles)), self._digest)
        return self._image

    def set_image(self, image: InkImage) -> None:
        """Replace all ink by that of another moment or world."""
        self._tiles, self._digest, self._image = dict(image.tiles), image.digest, image
        self._own.clear()

    def clear(self) -> None:
        """Remove all ink."""
        self.set_image(BLANK)

    @property
    def digest(self) -> int:
        """Checksum of all that was drawn since the world's reset; 0 if nothing was."""
        return self._digest

    def at(self, x: float, y: float) -> int:
        """Return the code of the ink at a place, on the highest floor there; 0 for none."""
        if not self._tiles:
            return NO_INK
        floor = self.floor_at(x, y)
        if floor is None:
            return NO_INK
        column, row = math.floor(x / CELL_M), math.floor(y / CELL_M)
        tile = self._tiles.get(TileKey(floor, column // TILE_CELLS, row // TILE_CELLS))
        return NO_INK if tile is None else int(tile[row % TILE_CELLS, column % TILE_CELLS])

    def floor_at(self, x: float, y: float, z: float | None = None) -> str | None:
        """Return the name of the highest floor at a place.

        Args:
            x: metres.
            y: metres.
            z: height that it must have; None for any.

        Returns:
            None over the void, or where the floor has another height.
        """
        if not self._floors:
            return ENDLESS if z is None or abs(z) <= _SAME_HEIGHT_M else None
        best: FloorDescription | None = None
        for floor, region in self._floors.values():
            if (best is None or floor.top > best.top) and region.contains(x, y):
                best = floor
        if best is None or (z is not None and abs(z - best.top) > _SAME_HEIGHT_M):
            return None
        return best.name

    def draw(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        z: float,
        width: float,
        code: int,
    ) -> None:
        """Draw a straight stroke with a round pen, on the floor under its end.

        Args:
            start: metres.
            end: metres.
            z: height at which the pen is; it reaches only a floor of that height.
            width: metres; a stroke is at least a cell wide.
            code: of the colour; 0 wipes ink away.
        """
        floor = self.floor_at(*end, z)
        if floor is None or math.dist(start, end) > MAX_STROKE_M:
            return
        radius = max(width / 2, 0.71 * CELL_M)  # half of a cell's diagonal leaves no gap
        (x0, y0), (x1, y1) = start, end
        left, right = _cells(min(x0, x1) - radius), _cells(max(x0, x1) + radius)
        low, high = _cells(min(y0, y1) - radius), _cells(max(y0, y1) + radius)
        xs = (np.arange(left, right + 1) + 0.5) * CELL_M
        ys = ((np.arange(low, high + 1) + 0.5) * CELL_M)[:, None]
        dx, dy = x1 - x0, y1 - y0
        length = dx * dx + dy * dy
        along = ((xs - x0) * dx + (ys - y0) * dy) / length if length else xs * 0.0 + ys * 0.0
        along = np.clip(along, 0.0, 1.0)
        inside = (xs - x0 - along * dx) ** 2 + (ys - y0 - along * dy) ** 2 <= radius * radius
        if floor in self._floors:
            inside &= self._floors[floor][1].contains_each(xs + 0 * ys, ys + 0 * xs)
        for key, rows, columns, part in _parts(floor, left, low, inside):
            self._put(key, rows, columns, part, code)

    def _put(
        self, key: TileKey, rows: slice, columns: slice, inside: npt.NDArray[np.bool_], code: int
    ) -> None:
        tile = self._tiles.get(key)
        if tile is None:
            if code == NO_INK or len(self._tiles) >= MAX_TILES or not inside.any():
                return
            tile = np.zeros((TILE_CELLS, TILE_CELLS), np.uint8)
            self._tiles[key] = tile
            self._own.add(key)
        elif not (inside & (tile[rows, columns] != code)).any():
            return  # a pen that stands still copies nothing
        if key not in self._own:
            tile = self._tiles[key] = tile.copy()
            self._own.add(key)
        tile[rows, columns][inside] = code
        place = f"{key} {rows.start} {columns.start} {inside.shape} {code}".encode()
        self._digest = crc32(inside.tobytes(), crc32(place, self._digest)) or 1
        self._image = None


def _cells(metres: float) -> int:
    return math.floor(metres / CELL_M)


def _parts(
    floor: str, left: int, low: int, inside: npt.NDArray[np.bool_]
) -> Iterator[tuple[TileKey, slice, slice, npt.NDArray[np.bool_]]]:
    """Yield the parts of a mask by tile: key, rows and columns in the tile, mask."""
    height, width = inside.shape
    for row in range(low // TILE_CELLS, (low + height - 1) // TILE_CELLS + 1):
        bottom = max(low, row * TILE_CELLS)
        top = min(low + height, (row + 1) * TILE_CELLS)
        for column in range(left // TILE_CELLS, (left + width - 1) // TILE_CELLS + 1):
            start = max(left, column * TILE_CELLS)
            end = min(left + width, (column + 1) * TILE_CELLS)
            yield (
                TileKey(floor, column, row),
                slice(bottom - row * TILE_CELLS, top - row * TILE_CELLS),
                slice(start - column * TILE_CELLS, end - column * TILE_CELLS),
                inside[bottom - low : top - low, start - left : end - left],
            )
