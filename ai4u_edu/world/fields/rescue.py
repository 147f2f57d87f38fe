"""Rescue lines: tiles with a line, marks at its crossings, obstacles on it, and a room at its end.

They are in the manner of the rescue line of RoboCup Junior and of the Brazilian robot olympics
(OBR), with what a plane allows: gaps, green marks that say the way at a crossing, obstacles, and a
room with walls, into which a grey strip leads and in which a victim waits.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated, Literal, NamedTuple, Self

import numpy as np
from pydantic import Field, model_validator

from ai4u_edu.base.errors import WorldError
from ai4u_edu.base.parameters import Name, Point, PositiveMetres, quantity
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.descriptions import AreaDescription, BodyDescription
from ai4u_edu.world.fields.field import (
    STEPS,
    Cell,
    GeneratedField,
    direction_to,
    is_straight,
    moved,
)
from ai4u_edu.world.fields.line import LineBase
from ai4u_edu.world.shapes import BoxShape

MAX_TRIES = 400
"""Fields that are begun before a description counts as impossible."""
CURVES_OF_NEXT_TRY = 0.96
"""Probability to turn in the next try, as a share of the one in this try."""
MAX_SEARCH_STEPS = 400
"""Tiles that are tried for the line of one of them."""
FIRST_SPECIAL_TILE = 2
"""The first tiles have the line alone, so that a robot is on it before something happens."""
MARK_SHARE = 0.2
"""Side of a green mark and depth of the grey strip, as a share of a tile."""
OBSTACLE_SHARE = 0.3
"""Side of an obstacle, as a share of a tile."""


class RescueField(LineBase):
    """A line over tiles, with crossings, gaps and obstacles, which ends in a room with a victim.

    A green mark beside the line says on which side it goes on at the crossing behind it; without
    one it goes straight on. A grey strip lies in the entrance of the room, where the line ends.

    >>> rescue = RescueField(width=8, height=6, length=14)
    >>> made = rescue.generate(np.random.default_rng(1))
    >>> sorted({tag for piece in made.pieces for tag in piece.tags}), sorted(made.places)
    (['entrance', 'line', 'mark', 'obstacle', 'wall'], ['robot', 'victim'])
    """

    type: Literal["rescue"] = "rescue"
    width: Annotated[int, Field(ge=5, le=20)] = 8
    """Number of tiles along x."""
    height: Annotated[int, Field(ge=5, le=20)] = 6
    """Number of tiles along y."""
    length: Annotated[int, Field(ge=5, le=150)] = 14
    """Number of tiles through which the line goes."""
    crossings: Annotated[int, Field(ge=0, le=10)] = 1
    """Number of crossings; the first has a green mark."""
    gaps: Annotated[int, Field(ge=0, le=20)] = 1
    """Number of gaps, in straight parts."""
    obstacles: Annotated[int, Field(ge=0, le=10)] = 1
    """Number of obstacles on the line, around which a robot has to drive."""
    difficulty: Annotated[float, quantity("1", gt=0, le=1)] = 1.0
    """Share of the length, crossings, gaps and obstacles that there are; at least one of each."""
    room_size: Annotated[int, Field(ge=2, le=4)] = 2
    """Number of tiles along each side of the room."""
    wall: PositiveMetres = 0.2
    """Thickness of the room's walls (m)."""
    wall_height: PositiveMetres = 1.0
    """Height of walls and obstacles (m)."""
    goal: Name = "victim"
    """The body or area in the room."""

    @model_validator(mode="after")
    def _has_room(self) -> Self:
        if self.wall > self.cell / 4:
            raise ValueError(
                _(
                    "expected walls of at most a quarter of a cell ({cell:g} m), got {wall:g}",
                    cell=self.cell / 4,
                    wall=self.wall,
                )
            )
        if self.room_size > min(self.width, self.height) - 3:
            raise ValueError(
                _(
                    "expected a room_size of at most {most} tiles in a field of {width} x "
                    "{height}, got {room_size}",
                    most=min(self.width, self.height) - 3,
                    width=self.width,
                    height=self.height,
                    room_size=self.room_size,
                )
            )
        most = (self.width * self.height - self.room_size**2) // 2
        if self.length > most:
            raise ValueError(
                _(
                    "expected a length of at most {most} tiles in a field of {width} x {height} "
                    "with a room of {room_size} x {room_size}, got {length}",
                    most=most,
                    width=self.width,
                    height=self.height,
                    room_size=self.room_size,
                    length=self.length,
                )
            )
        least = _least_length(self.crossings, self.gaps, self.obstacles)
        if self.length < least:
            raise ValueError(
                _(
                    "expected a length of at least {least} tiles for {crossings} crossings, "
                    "{gaps} gaps and {obstacles} obstacles, got {length}",
                    least=least,
                    crossings=self.crossings,
                    gaps=self.gaps,
                    obstacles=self.obstacles,
                    length=self.length,
                )
            )
        return self

    def room(self) -> float:
        """Return half of what the walls leave of a tile."""
        return (self.cell - self.wall) / 2

    def margin(self) -> float:
        """Return half a wall."""
        return self.wall / 2

    def generate(self, rng: np.random.Generator) -> GeneratedField:
        """Return a rescue line.

        Raises:
            WorldError: none of that kind was found.
        """
        for number in range(MAX_TRIES):
            # gaps and obstacles need straight parts: each try turns a bit less than the last one
            curves = self.curves * CURVES_OF_NEXT_TRY**number
            layout = _Layout.found(self, curves, rng)
            if layout is not None:
                return self._built(layout, rng)
        raise WorldError(
            _(
                "found no rescue line of {length} tiles with {crossings} crossings, {gaps} gaps "
                "and {obstacles} obstacles in {max_tries} tries; make it shorter, the field "
                "larger, or give it fewer of them",
                length=self.length,
                crossings=self.crossings,
                gaps=self.gaps,
                obstacles=self.obstacles,
                max_tries=MAX_TRIES,
            ),
            thing="generate",
        )

    def scaled(self, count: int) -> int:
        """Return how many of a count there are at this difficulty; at least one of any."""
        return math.ceil(self.difficulty * count - 1e-9)

    def _built(self, layout: "_Layout", rng: np.random.Generator) -> GeneratedField:
        path = layout.path
        pieces = [*self.painted(self._parts(layout)), *self._marks(layout)]
        pieces.append(self._entrance(layout))
        solid = [*self._obstacles(layout), *self._walls(layout)]
        size = self.room_size
        others = [
            (layout.corner[0] + x, layout.corner[1] + y) for y in range(size) for x in range(size)
        ]
        others.remove(path[-1])
        goal = others[int(rng.integers(len(others)))]
        places: dict[str, tuple[Point, float | None]] = {
            self.start: (self.centre(path[0]), 90.0 * direction_to(path[0], path[1])),
            self.goal: (self.centre(goal), None),
        }
        for number, name in enumerate(self.marks, 1):
            index = round(number * (len(path) - 2) / (len(self.marks) + 1))
            # a mark under an obstacle could not be reached
            index += index in layout.obstacles
            places[name] = self.centre(path[index]), None
        blocked = tuple(self.centre(path[index]) for index in sorted(layout.obstacles))
        return GeneratedField((*pieces, *solid), places, blocked)

    def _parts(self, layout: "_Layout") -> Iterator[tuple[Point, Point]]:
        """Yield the straight parts of the line and of its branches."""
        path = layout.path
        for index in range(len(path) - 1):
            if index not in layout.branches:
                yield from self.parts_in(path, index, has_gap=index in layout.gaps)
                continue
            x, y = centre = self.centre(path[index])
            before, after = (
                STEPS[direction_to(path[index], path[other])] for other in (index - 1, index + 1)
            )
            half = self.cell / 2
            yield (x + before[0] * half, y + before[1] * half), centre
            yield centre, (x + after[0] * half, y + after[1] * half)
        for index, ends in layout.branches.items():
            for end in ends:
                yield self.centre(path[index]), self.centre(end)

    def _marks(self, layout: "_Layout") -> Iterator[AreaDescription]:
        """Yield a green mark before each crossing at which the line turns, on that side."""
        side = MARK_SHARE * self.cell
        path = layout.path
        turns = [index for index in layout.branches if not is_straight(path, index)]
        for number, index in enumerate(turns, 1):
            x, y = self.centre(path[index])
            back = STEPS[direction_to(path[index], path[index - 1])]
            out = STEPS[direction_to(path[index], path[index + 1])]
            off = (self.line_width + side) / 2
            yield AreaDescription(
                name=f"field mark {number}",
                shape=BoxShape(size=(side, side)),
                position=(x + off * (back[0] + out[0]), y + off * (back[1] + out[1])),
                tags=("mark",),
                colour="green",
                paint=True,
            )

    def _entrance(self, layout: "_Layout") -> AreaDescription:
        """Return the grey strip before the room, as wide as its entrance."""
        before, inside = (self.centre(cell) for cell in layout.path[-2:])
        depth = MARK_SHARE * self.cell
        share = 0.5 - depth / 2 / self.cell
        return AreaDescription(
            name="field entrance",
            shape=BoxShape(size=(depth, self.cell - self.wall)),
            position=(
                before[0] + share * (inside[0] - before[0]),
                before[1] + share * (inside[1] - before[1]),
            ),
            heading_deg=90.0 * direction_to(*layout.path[-2:]),
            tags=("entrance",),
            colour="grey",
            paint=True,
        )

    def _obstacles(self, layout: "_Layout") -> Iterator[BodyDescription]:
        side = OBSTACLE_SHARE * self.cell
        for number, index in enumerate(sorted(layout.obstacles), 1):
            yield BodyDescription(
                name=f"field obstacle {number}",
                shape=BoxShape(size=(side, side)),
                kind="static",
                position=self.centre(layout.path[index]),
                height=self.wall_height,
                tags=("obstacle",),
                colour="vermillion",
            )

    def _walls(self, layout: "_Layout") -> Iterator[BodyDescription]:
        """Yield the walls of the room, with one tile left open in one of them."""
        way_in = direction_to(*layout.path[-2:])
        size, number = self.room_size, 0
        first = self.centre(layout.corner)
        half = (size - 1) / 2 * self.cell
        x, y = first[0] + half, first[1] + half
        inside = layout.path[-1]
        for side, (dx, dy) in enumerate(STEPS):
            runs = [(0, size)]
            if side == (way_in + 2) % 4:
                open_at = inside[1] - layout.corner[1] if dx else inside[0] - layout.corner[0]
                runs = [(0, open_at), (open_at + 1, size)]
            for begin, end in runs:
                if begin == end:
                    continue
                number += 1
                along = ((begin + end) / 2 - size / 2) * self.cell
                away = size / 2 * self.cell
                length = (end - begin) * self.cell + self.wall
                yield BodyDescription(
                    name=f"field wall {number}",
                    shape=BoxShape(size=(self.wall, length) if dx else (length, self.wall)),
                    kind="static",
                    position=(x + dx * away, y + along) if dx else (x + along, y + dy * away),
                    height=self.wall_height,
                    tags=("wall",),
                )


class _Counts(NamedTuple):
    """Numbers of things on one line."""

    crossings: int
    gaps: int
    obstacles: int
    length: int


def _least_length(crossings: int, gaps: int, obstacles: int) -> int:
    return 5 + 2 * crossings + 2 * gaps + 3 * obstacles


@dataclass
class _Layout:
    """The tiles of one field.

    Attributes:
        path: tiles of the line from the start on; the last one is the first tile of the room.
        corner: lower left tile of the room.
        branches: tiles in which the false ways of each crossing end, by its number in the path.
        gaps: numbers in the path of the tiles with a gap.
        obstacles: numbers in the path of the tiles with an obstacle.
    """

    path: list[Cell]
    corner: Cell
    branches: dict[int, list[Cell]] = field(default_factory=dict)
    gaps: set[int] = field(default_factory=set)
    obstacles: set[int] = field(default_factory=set)

    @classmethod
    def found(
        cls, description: RescueField, curves: float, rng: np.random.Generator
    ) -> "_Layout | None":
        """Return a layout; None if this try led to none.

        Args:
            description: the field.
            curves: probability to turn, in place of the description's.
            rng: makes all choices.
        """
        crossings, gaps, obstacles = (
            description.scaled(count)
            for count in (description.crossings, description.gaps, description.obstacles)
        )
        least = _least_length(crossings, gaps, obstacles)
        length = max(least, description.scaled(description.length))
        size = description.room_size
        corner = (
            int(rng.integers(description.width - size + 1)),
            int(rng.integers(description.height - size + 1)),
        )
        path = _PathSearch(description, corner, (length, curves), rng).run()
        if path is None:
            return None
        layout = cls(path, corner)
        counts = _Counts(crossings, gaps, obstacles, length)
        return layout if layout._filled(description, counts, rng) else None

    def _filled(self, description: RescueField, counts: _Counts, rng: np.random.Generator) -> bool:
        """Put crossings, obstacles and gaps on the line; return False if there are too few."""
        order = [
            FIRST_SPECIAL_TILE + int(index)
            for index in rng.permutation(len(self.path) - 2 - FIRST_SPECIAL_TILE)
        ]
        for index in order:
            if len(self.branches) < counts.crossings and self._is_plain(index):
                ends = self._free_sides(description, index)
                # the first one teaches what a mark means: there is always one
                if ends and (self.branches or not is_straight(self.path, index)):
                    keep = 1 + int(rng.integers(len(ends)))
                    chosen = rng.permutation(len(ends))[:keep].tolist()
                    self.branches[index] = [ends[each] for each in chosen]
        for index in order:
            if len(self.obstacles) < counts.obstacles and self._has_way_around(description, index):
                self.obstacles.add(index)
        for index in order:
            is_free = self._is_plain(index) and is_straight(self.path, index)
            if len(self.gaps) < counts.gaps and is_free:
                self.gaps.add(index)
        self.branches = dict(sorted(self.branches.items()))
        return (len(self.branches), len(self.gaps), len(self.obstacles)) == counts[:3]

    def _is_plain(self, index: int) -> bool:
        """Return True if nothing is in a tile of the line, in the one before and the one behind."""
        special = {*self.branches, *self.gaps, *self.obstacles}
        return special.isdisjoint((index - 1, index, index + 1))

    def _free_sides(self, description: RescueField, index: int) -> list[Cell]:
        """Return the neighbours of a tile into which a false way may lead."""
        taken = {*self.path, *(end for ends in self.branches.values() for end in ends)}
        around = [moved(self.path[index], side) for side in range(4)]
        return [
            cell
            for cell in around
            if description.inside(cell)
            and cell not in taken
            and not self._in_room(description, cell)
        ]

    def _has_way_around(self, description: RescueField, index: int) -> bool:
        """Return True if an obstacle may stand in a tile, with room on both sides."""
        path = self.path
        if not self._is_plain(index) or not all(
            is_straight(path, each) for each in (index - 1, index, index + 1)
        ):
            return False
        x, y = path[index]
        around = [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        is_open = all(
            description.inside(cell) and not self._in_room(description, cell) for cell in around
        )
        others = [path[each] for each in self.obstacles]
        return is_open and all(max(abs(each[0] - x), abs(each[1] - y)) > 2 for each in others)

    def _in_room(self, description: RescueField, cell: Cell) -> bool:
        return _is_in_square(cell, self.corner, description.room_size)


class _PathSearch:
    """Search for a line that ends at a room and never crosses itself, from its end backwards.

    Args:
        field: its description.
        corner: lower left tile of the room.
        shape: number of tiles outside the room, and probability to turn in one.
        rng: chooses the room's entrance, and among the ways to go on.
    """

    def __init__(
        self,
        description: RescueField,
        corner: Cell,
        shape: tuple[int, float],
        rng: np.random.Generator,
    ) -> None:
        self._field, self._corner, self._rng = description, corner, rng
        self._length, self._curves = shape
        self._path: list[Cell] = []
        self._steps = 0

    def run(self) -> list[Cell] | None:
        """Return the tiles from the start to the first one of the room; None if none was found."""
        rng, size = self._rng, self._field.room_size
        way_out = int(rng.integers(4))
        across = int(rng.integers(size))
        far = size - 1 if way_out < 2 else 0
        x, y = (far, across) if way_out % 2 == 0 else (across, far)
        self._path = [(self._corner[0] + x, self._corner[1] + y)]
        # the last two tiles are straight, so that a robot enters the room straight
        for _tile in range(2):
            cell = moved(self._path[-1], way_out)
            if not self._field.inside(cell):
                return None
            self._path.append(cell)
        return self._path[::-1] if self._goes_on(way_out) else None

    def _goes_on(self, way: int) -> bool:
        """Go on from the last tile to the other end of the line."""
        if len(self._path) == self._length + 1:
            return True
        for following in self._ways(way):
            self._steps += 1
            cell = moved(self._path[-1], following)
            is_free = (
                self._field.inside(cell)
                and cell not in self._path
                and not _is_in_square(cell, self._corner, self._field.room_size)
            )
            if is_free and self._steps <= MAX_SEARCH_STEPS:
                self._path.append(cell)
                if self._goes_on(following):
                    return True
                self._path.pop()
        return False

    def _ways(self, way: int) -> list[int]:
        """Return the directions in which to try to go on."""
        left, right = (way + 1) % 4, (way - 1) % 4
        turns = [left, right] if self._rng.random() < 0.5 else [right, left]
        is_turning = self._rng.random() < self._curves
        return [*turns, way] if is_turning else [way, *turns]


def _is_in_square(cell: Cell, corner: Cell, size: int) -> bool:
    return all(0 <= cell[axis] - corner[axis] < size for axis in (0, 1))
