"""A rescue line as seen from above: which way its rules lead, and where a robot has room."""

import math
from collections import deque

import numpy as np

from ai4u_edu.world import AreaDescription, BodyDescription, BoxShape, Region, RescueField
from ai4u_edu.world.fields import GeneratedField

RASTER_M = 0.1
ROBOT_M = 0.4
"""Radius of a robot that has to get through (m)."""
STEPS = (1, 0), (0, 1), (-1, 0), (0, -1)

Tile = tuple[int, int]


class Reading:
    """A rescue line as it can be seen from above.

    Args:
        field: its description, of which the size of the tiles is used.
        made: the line itself.
    """

    def __init__(self, field: RescueField, made: GeneratedField) -> None:
        self.field, self.made = field, made
        areas = [each for each in made.pieces if isinstance(each, AreaDescription)]
        self._painted = {
            tag: [Region(each) for each in areas if tag in each.tags]
            for tag in ("line", "mark", "entrance")
        }
        self.solid = [_rectangle(each) for each in made.pieces if isinstance(each, BodyDescription)]

    def tile_at(self, place: tuple[float, float]) -> Tile:
        """Return the tile around a place."""
        tiles = [(x, y) for y in range(self.field.height) for x in range(self.field.width)]
        return min(tiles, key=lambda tile: math.dist(self.field.centre(tile), place))

    def has(self, tag: str, tile: Tile, along: float, way: int, across: float = 0.0) -> bool:
        """Return True if something with a tag is painted at a place in a tile.

        Args:
            tag: of the area.
            tile: in which to look.
            along: distance (m) from the tile's middle, in the direction of ``way``.
            way: direction, 0 to 3.
            across: distance (m) to the left of ``way``.
        """
        (x, y), (dx, dy) = self.field.centre(tile), STEPS[way]
        at = x + dx * along - dy * across, y + dy * along + dx * across
        return any(piece.contains(*at) for piece in self._painted[tag])

    def follow(self) -> list[Tile]:
        """Return the tiles from the start to the entrance, by the rules that the robot has."""
        field, half = self.field, 0.45 * self.field.cell
        place, heading = self.made.places[field.start]
        tile, way = self.tile_at(place), round((heading or 0.0) / 90) % 4
        tiles = [tile]
        mark = (field.line_width + 0.2 * field.cell) / 2
        while not self.has("entrance", tile, half, way):
            tile = tile[0] + STEPS[way][0], tile[1] + STEPS[way][1]
            tiles.append(tile)
            back = (way + 2) % 4
            exits = [side for side in range(4) if side != back]
            exits = [side for side in exits if self.has("line", tile, half, side)]
            assert exits, f"the line ends in tile {tile}"
            left, right = (self.has("mark", tile, -mark, way, side * mark) for side in (1, -1))
            assert left + right < 2
            if len(exits) == 1:
                assert left == right == 0, "a mark where there is no crossing"
                way = exits[0]
            else:
                way = (way + left - right) % 4
            assert way in exits, f"the rules lead off the line in tile {tile}"
            assert len(tiles) <= field.width * field.height, "a circle"
        return tiles

    def is_within_reach(self, begin: tuple[float, float], end: tuple[float, float]) -> bool:
        """Return True if a robot can drive from a place to another one between all bodies."""
        (left, low), (right, high) = self.field.bounds()
        xs = np.arange(left, right, RASTER_M)
        ys = np.arange(low, high, RASTER_M)
        grid_x, grid_y = np.meshgrid(xs, ys, indexing="ij")
        is_open = np.ones_like(grid_x, np.bool_)
        for x0, y0, x1, y1 in self.solid:
            near_x = np.maximum(np.maximum(x0 - grid_x, grid_x - x1), 0)
            near_y = np.maximum(np.maximum(y0 - grid_y, grid_y - y1), 0)
            is_open &= np.hypot(near_x, near_y) > ROBOT_M
        first, goal = (
            (round((x - left) / RASTER_M), round((y - low) / RASTER_M)) for x, y in (begin, end)
        )
        queue, seen = deque([first]), {first}
        while queue:
            here = queue.popleft()
            if here == goal:
                return True
            for dx, dy in STEPS:
                there = here[0] + dx, here[1] + dy
                is_inside = 0 <= there[0] < len(xs) and 0 <= there[1] < len(ys)
                if is_inside and there not in seen and is_open[there]:
                    seen.add(there)
                    queue.append(there)
        return False


def _rectangle(body: BodyDescription) -> tuple[float, float, float, float]:
    assert isinstance(body.shape, BoxShape)
    (x, y), (a, b) = body.position, body.shape.size
    return x - a / 2, y - b / 2, x + a / 2, y + b / 2
