"""Fields that are generated for each episode from its seed: mazes, and lines on the ground."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from ai4u_edu.base.errors import WorldError, suggest
from ai4u_edu.base.parameters import Name, Point, PositiveMetres, quantity
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.world.descriptions import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.shapes import BoxShape, Description

Thing = BodyDescription | FloorDescription | AreaDescription
Cell = tuple[int, int]
"""Column and row, from the lower left corner."""
Rectangle = tuple[Point, Point]

EAST, NORTH, WEST, SOUTH = range(4)
STEPS: tuple[Cell, ...] = (1, 0), (0, 1), (-1, 0), (0, -1)
"""Steps to the neighbours, by direction."""
MAX_PIECES = 480
"""Walls of a field: a world has room for 500 bodies."""
MAX_TRIES = 400
"""Lines that are begun before a description counts as impossible; one in two or three succeeds."""
MAX_SEARCH_STEPS = 600
"""Tiles that are tried for one of them."""
CURVE_PARTS = 4
"""Straight parts of a curve."""
GAP_SHARE = 0.4
"""Share of a tile that a gap takes."""


@dataclass(frozen=True)
class GeneratedField:
    """A field as generated for one episode."""

    pieces: tuple[Thing, ...]
    """New things, which no scene file names."""
    places: Mapping[str, tuple[Point, float | None]]
    """Position, and heading (degrees) where the field decides it, of things in the scene."""


class FieldBase(Description):
    """The size of a field and the things of the scene that it places."""

    width: Annotated[int, Field(ge=2, le=20)] = 6
    """Number of cells along x."""
    height: Annotated[int, Field(ge=2, le=20)] = 5
    """Number of cells along y."""
    cell: PositiveMetres = 2.0
    """Side of a cell (m)."""
    position: Point = (0.0, 0.0)
    """Centre of the field."""
    start: Name = "robot"
    """The body that begins at the field's beginning."""

    def bounds(self) -> Rectangle:
        """Return a rectangle ((x0, y0), (x1, y1)), metres, around the field of any seed."""
        more = self.margin()
        x, y = self.width * self.cell / 2 + more, self.height * self.cell / 2 + more
        left, low = self.position
        return (left - x, low - y), (left + x, low + y)

    def margin(self) -> float:
        """Return by how much (m) a field is larger than its cells, on each side."""
        return 0.0

    def names(self) -> dict[str, str]:
        """Return the names of things that the scene must have, with the parameter of each."""
        return {self.start: "start"}

    def centre(self, cell: Cell) -> Point:
        """Return the centre of a cell in the world (m)."""
        x = self.position[0] + (cell[0] + 0.5 - self.width / 2) * self.cell
        y = self.position[1] + (cell[1] + 0.5 - self.height / 2) * self.cell
        return x, y

    def inside(self, cell: Cell) -> bool:
        """Return True for a cell of the field."""
        return 0 <= cell[0] < self.width and 0 <= cell[1] < self.height


class MazeField(FieldBase):
    """A maze of cells with walls between them; each cell can be reached from each.

    >>> maze = MazeField(width=4, height=3)
    >>> field = maze.generate(np.random.default_rng(1))
    >>> len(field.pieces) < 20, sorted(field.places)
    (True, ['exit', 'robot'])
    """

    type: Literal["maze"] = "maze"
    loops: Annotated[int, Field(ge=0, le=400)] = 0
    """Number of walls that are missing besides those of a maze with one way only."""
    difficulty: Annotated[float, quantity("1", gt=0, le=1)] = 1.0
    """Way from start to goal, as a share of the longest one in the maze."""
    wall: PositiveMetres = 0.2
    """Thickness of the walls (m)."""
    wall_height: PositiveMetres = 1.0
    """Height of the walls (m)."""
    goal: Name = "exit"
    """The body or area to reach."""

    @model_validator(mode="after")
    def _has_room(self) -> Self:
        if self.wall > self.cell / 2:
            raise ValueError(
                f"expected walls of at most half a cell ({self.cell / 2:g} m), got {self.wall:g}"
            )
        return self

    def margin(self) -> float:
        """Return half a wall."""
        return self.wall / 2

    def names(self) -> dict[str, str]:
        """Return start and goal."""
        return {self.start: "start", self.goal: "goal"}

    def generate(self, rng: np.random.Generator) -> GeneratedField:
        """Return a maze."""
        ways = self._carve(rng)
        far = _distances(ways, start := self._any_cell(rng))
        wanted = max(1, round(self.difficulty * max(far.values())))
        goals = [cell for cell, steps in far.items() if steps == wanted]
        goal = goals[int(rng.integers(len(goals)))]
        heading = 90.0 * _direction(start, min(ways[start]))
        walls = [
            BodyDescription(
                name=f"field wall {number}",
                shape=BoxShape(size=size),
                kind="static",
                position=place,
                height=self.wall_height,
                tags=("wall",),
            )
            for number, (place, size) in enumerate(self._walls(ways), 1)
        ]
        places = {self.start: (self.centre(start), heading), self.goal: (self.centre(goal), None)}
        return GeneratedField(tuple(walls), places)

    def _any_cell(self, rng: np.random.Generator) -> Cell:
        return int(rng.integers(self.width)), int(rng.integers(self.height))

    def _carve(self, rng: np.random.Generator) -> dict[Cell, set[Cell]]:
        """Return the neighbours that can be reached from each cell."""
        cells = [(x, y) for y in range(self.height) for x in range(self.width)]
        ways: dict[Cell, set[Cell]] = {cell: set() for cell in cells}
        stack = [self._any_cell(rng)]
        reached = {stack[0]}
        while stack:
            here = stack[-1]
            free = [each for each in _neighbours(here) if each in ways and each not in reached]
            if not free:
                stack.pop()
                continue
            following = free[int(rng.integers(len(free)))]
            ways[here].add(following)
            ways[following].add(here)
            reached.add(following)
            stack.append(following)
        walls = [
            (cell, each)
            for cell in cells
            for each in _neighbours(cell)
            if each > cell and each in ways and each not in ways[cell]
        ]
        for index in rng.permutation(len(walls))[: self.loops].tolist():
            one, other = walls[index]
            ways[one].add(other)
            ways[other].add(one)
        return ways

    def _walls(self, ways: Mapping[Cell, set[Cell]]) -> Iterator[tuple[Point, Point]]:
        """Yield position and size of the walls; those in one line are one."""
        side, thick = self.cell, self.wall
        left, low = self.centre((0, 0))[0] - side / 2, self.centre((0, 0))[1] - side / 2
        for y in range(self.height + 1):
            shut = [(x, y) not in ways.get((x, y - 1), ()) for x in range(self.width)]
            for first, end in _runs(shut):
                middle = left + (first + end) / 2 * side
                yield (middle, low + y * side), ((end - first) * side + thick, thick)
        for x in range(self.width + 1):
            shut = [(x, y) not in ways.get((x - 1, y), ()) for y in range(self.height)]
            for first, end in _runs(shut):
                middle = low + (first + end) / 2 * side
                yield (left + x * side, middle), (thick, (end - first) * side + thick)


class LineField(FieldBase):
    """A line on the ground from one end to the other, which turns, crosses itself and has gaps.

    >>> line = LineField(width=8, height=6, length=20, crossings=1, gaps=1)
    >>> field = line.generate(np.random.default_rng(1))
    >>> {tag for piece in field.pieces for tag in piece.tags}, sorted(field.places)
    ({'line'}, ['finish', 'robot'])
    """

    type: Literal["line"] = "line"
    cell: PositiveMetres = 1.5
    """Side of a cell (m)."""
    length: Annotated[int, Field(ge=3, le=200)] = 16
    """Number of cells through which the line goes; one that it crosses counts twice."""
    curves: Annotated[float, quantity("1", ge=0, le=1)] = 0.5
    """Probability that the line tries to turn in a cell: 0 only where it has to, 1 where it can."""
    crossings: Annotated[int, Field(ge=0, le=10)] = 0
    """Number of times that the line crosses itself, at a right angle."""
    gaps: Annotated[int, Field(ge=0, le=20)] = 0
    """Number of gaps, in straight parts."""
    line_width: PositiveMetres = 0.25
    """Width of the line (m)."""
    goal: Name = "finish"
    """The body or area at its end."""
    marks: tuple[Name, ...] = ()
    """Areas of the scene that are put on the line at equal distances, in this order."""

    @model_validator(mode="after")
    def _has_room(self) -> Self:
        most = int(0.6 * self.width * self.height) - 4 * self.crossings
        if self.length > most:
            raise ValueError(
                f"expected a length of at most {most} cells in a field of {self.width} x "
                f"{self.height} with {self.crossings} crossings, got {self.length}"
            )
        least = 3 + 6 * self.crossings + 3 * self.gaps
        if self.length < least:
            raise ValueError(
                f"expected a length of at least {least} cells for {self.crossings} crossings and "
                f"{self.gaps} gaps, got {self.length}"
            )
        if self.line_width > self.cell / 3:
            raise ValueError(
                f"expected a line_width of at most a third of a cell ({self.cell / 3:g} m), "
                f"got {self.line_width:g}"
            )
        return self

    def margin(self) -> float:
        """Return 0: the line ends in the middle of cells, and keeps inside."""
        return 0.0

    def names(self) -> dict[str, str]:
        """Return start, goal and marks."""
        return {self.start: "start", self.goal: "goal"} | dict.fromkeys(self.marks, "marks")

    def generate(self, rng: np.random.Generator) -> GeneratedField:
        """Return a line.

        Raises:
            WorldError: none of that kind was found.
        """
        for _ in range(MAX_TRIES):
            path = _LineSearch(self, rng).run()
            gaps = None if path is None else self._gaps(path, rng)
            if path is not None and gaps is not None:
                return self._built(path, gaps)
        raise WorldError(
            f"found no line of {self.length} cells with {self.crossings} crossings and "
            f"{self.gaps} gaps in {MAX_TRIES} tries; make it shorter, the field larger, or give it "
            "fewer curves",
            thing="generate",
        )

    def _gaps(self, path: Sequence[Cell], rng: np.random.Generator) -> set[int] | None:
        """Return the numbers of straight cells with a gap; None if there are too few."""
        found: set[int] = set()
        candidates = [
            index
            for index in range(2, len(path) - 2)
            if _is_straight(path, index) and path.count(path[index]) == 1
        ]
        for index in rng.permutation(len(candidates)).tolist():
            place = candidates[index]
            if len(found) < self.gaps and not {place - 1, place + 1} & found:
                found.add(place)
        return found if len(found) == self.gaps else None

    def _built(self, path: Sequence[Cell], gaps: set[int]) -> GeneratedField:
        parts = list(
            _joined(
                part
                for index in range(len(path))
                for part in self._in_cell(path, index, index in gaps)
            )
        )
        pieces = [
            AreaDescription(
                name=f"field line {number}",
                shape=BoxShape(size=(math.dist(one, other) + self.line_width, self.line_width)),
                position=((one[0] + other[0]) / 2, (one[1] + other[1]) / 2),
                heading_deg=math.degrees(math.atan2(other[1] - one[1], other[0] - one[0])),
                tags=("line",),
                colour="black",
                paint=True,
            )
            for number, (one, other) in enumerate(parts, 1)
        ]
        heading = 90.0 * _direction(path[0], path[1])
        places: dict[str, tuple[Point, float | None]] = {
            self.start: (self.centre(path[0]), heading),
            self.goal: (self.centre(path[-1]), None),
        }
        for number, name in enumerate(self.marks, 1):
            index = round(number * (len(path) - 1) / (len(self.marks) + 1))
            places[name] = self.centre(path[index]), None
        return GeneratedField(tuple(pieces), places)

    def _in_cell(
        self, path: Sequence[Cell], index: int, has_gap: bool
    ) -> Iterator[tuple[Point, Point]]:
        """Yield the straight parts of the line in one of its cells."""
        x, y = self.centre(path[index])
        half = self.cell / 2
        ends: list[Point] = []
        for other in (index - 1, index + 1):
            if 0 <= other < len(path):
                dx, dy = path[other][0] - path[index][0], path[other][1] - path[index][1]
                ends.append((x + dx * half, y + dy * half))
            else:
                ends.append((x, y))
        one, other_end = ends
        if index in (0, len(path) - 1) or _is_straight(path, index):
            if not has_gap:
                yield one, other_end
                return
            share = (1 - GAP_SHARE) / 2
            # each piece is longer than its part by the line's width
            more = self.line_width / 2 / self.cell
            yield one, _between(one, other_end, share - more)
            yield _between(one, other_end, 1 - share + more), other_end
            return
        # a quarter of a circle around the corner between the two sides
        corner = one[0] + other_end[0] - x, one[1] + other_end[1] - y
        begin = math.atan2(one[1] - corner[1], one[0] - corner[0])
        turn = math.atan2(other_end[1] - corner[1], other_end[0] - corner[0]) - begin
        turn = (turn + math.pi) % (2 * math.pi) - math.pi
        angles = [begin + turn * part / CURVE_PARTS for part in range(CURVE_PARTS + 1)]
        points = [
            (corner[0] + half * math.cos(angle), corner[1] + half * math.sin(angle))
            for angle in angles
        ]
        yield from pairwise(points)


FieldDescription = Annotated[MazeField | LineField, Field(discriminator="type")]


class _LineSearch:
    """Search for one path over the cells of a field, with backtracking.

    Args:
        field: the line's description.
        rng: chooses among the ways to go on.
    """

    def __init__(self, field: LineField, rng: np.random.Generator) -> None:
        self._field, self._rng = field, rng
        self._path: list[Cell] = []
        self._steps = 0

    def run(self) -> list[Cell] | None:
        """Return the cells of a path; None if none was found in time."""
        field, rng = self._field, self._rng
        first = int(rng.integers(field.width)), int(rng.integers(field.height))
        self._path = [first]
        directions = rng.permutation(4).tolist()
        for direction in directions:
            if self._extend(direction, field.crossings):
                return self._path
        return None

    def _extend(self, direction: int, crossings: int) -> bool:
        """Go one cell on in a direction, and on from there to the end."""
        self._steps += 1
        if self._steps > MAX_SEARCH_STEPS:
            return False
        following = _moved(self._path[-1], direction)
        if not self._field.inside(following) or following in self._path:
            return False
        self._path.append(following)
        left = self._field.length - len(self._path)
        if left == 0 and crossings == 0:
            return True
        if left > 0:
            if crossings and self._wants_loop(left, crossings):
                for side in self._rng.permutation([1, -1]).tolist():
                    if self._loop(direction, side, crossings):
                        return True
            if any(self._extend(each, crossings) for each in self._ways(direction)):
                return True
        self._path.pop()
        return False

    def _wants_loop(self, left: int, crossings: int) -> bool:
        """Return True if a loop should begin here; the last ones become urgent."""
        spare = left - 6 * crossings
        return spare >= 0 and float(self._rng.random()) < 1.0 / (1 + spare / crossings / 2)

    def _loop(self, direction: int, side: int, crossings: int) -> bool:
        """Go straight on, turn three times to the same side, and cross the way."""
        crossed, length = self._path[-1], len(self._path)
        if length < 2:
            return False
        way = [direction, (direction + side) % 4, (direction + 2 * side) % 4]
        for each in way:
            following = _moved(self._path[-1], each)
            if not self._field.inside(following) or following in self._path:
                del self._path[length:]
                return False
            self._path.append(following)
        out = (direction + 3 * side) % 4
        self._path.append(crossed)
        # beyond the crossing the line goes straight on
        if len(self._path) < self._field.length and self._extend(out, crossings - 1):
            return True
        del self._path[length:]
        return False

    def _ways(self, direction: int) -> list[int]:
        """Return the directions in which to try to go on."""
        rng = self._rng
        left, right = (direction + 1) % 4, (direction - 1) % 4
        turns = [left, right] if rng.random() < 0.5 else [right, left]
        first = rng.random() < self._field.curves
        return [*turns, direction] if first else [direction, *turns]


def place_field(
    field: MazeField | LineField, things: Sequence[Thing], seed: int
) -> tuple[dict[str, Thing], list[Thing]]:
    """Generate a field, and put the things of a scene into it.

    Bodies that can move and have no random place stand in the middle of a cell, so that no wall
    goes through them; start, goal and marks where the field has them.

    Args:
        field: its description.
        things: everything in the scene, as described.
        seed: the episode's seed.

    Returns:
        The things of the scene that are put somewhere, by name, and the new pieces.

    Raises:
        WorldError: something that the field places is not there or too large.
    """
    check_field(field, things)
    generated = field.generate(Seeds(seed).child("field"))
    taken = {place for place, _ in generated.places.values()}
    placed: dict[str, Thing] = {}
    for thing in things:
        put = generated.places.get(thing.name)
        if put is None and isinstance(field, MazeField) and _stands_in(thing, field):
            put = _nearest_free(field, thing.position, taken), None
            taken.add(put[0])
        if put is not None:
            placed[thing.name] = _put(thing, *put)
    return placed, list(generated.pieces)


def check_field(field: MazeField | LineField, things: Sequence[Thing]) -> None:
    """Check that a scene has the things that a field places, and that they fit.

    Raises:
        WorldError: one is missing or does not fit; it names the thing.
    """
    known = {thing.name: thing for thing in things}
    for name, parameter in field.names().items():
        if name not in known:
            raise WorldError(
                f"{parameter}: nothing is named {name!r}; {suggest(name, known)}",
                thing="generate",
            )
    if isinstance(field, MazeField):
        room = (field.cell - field.wall) / 2
        for thing in things:
            is_placed = thing.name in field.names() or _stands_in(thing, field)
            if is_placed and isinstance(thing, BodyDescription) and thing.shape.reach > room:
                raise WorldError(
                    f"body {thing.name!r} reaches {thing.shape.reach:g} m, and a cell has room "
                    f"for {room:g} m; make the cells larger",
                    thing=thing.name,
                )


def _put(thing: Thing, place: Point, heading: float | None) -> Thing:
    """Return a thing at the place that a field gives it; chance has no part in it."""
    fresh: dict[str, object] = {"position": place, "random": None}
    if heading is not None:
        fresh["heading_deg"] = heading
    return thing.model_copy(update=fresh)


def _stands_in(thing: Thing, field: FieldBase) -> bool:
    """Return True for a body that can move and has a fixed place inside a field."""
    (left, low), (right, high) = field.bounds()
    x, y = thing.position
    is_mover = isinstance(thing, BodyDescription) and thing.kind != "static"
    return is_mover and thing.random is None and left <= x <= right and low <= y <= high


def _nearest_free(field: FieldBase, place: Point, taken: set[Point]) -> Point:
    cells = [field.centre((x, y)) for y in range(field.height) for x in range(field.width)]
    free = [each for each in cells if each not in taken]
    if not free:
        raise WorldError(
            "expected a cell for each body that can move; make more cells", thing="generate"
        )
    return min(free, key=lambda each: math.dist(each, place))


def _neighbours(cell: Cell) -> list[Cell]:
    return [_moved(cell, direction) for direction in range(4)]


def _moved(cell: Cell, direction: int) -> Cell:
    return cell[0] + STEPS[direction][0], cell[1] + STEPS[direction][1]


def _direction(one: Cell, other: Cell) -> int:
    """Return the direction from a cell to its neighbour."""
    return STEPS.index((other[0] - one[0], other[1] - one[1]))


def _distances(ways: Mapping[Cell, set[Cell]], start: Cell) -> dict[Cell, int]:
    """Return the number of steps from a cell to each one that can be reached."""
    found, queue = {start: 0}, [start]
    for here in queue:
        for following in sorted(ways[here]):
            if following not in found:
                found[following] = found[here] + 1
                queue.append(following)
    return found


def _runs(flags: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """Yield first and end of each run of True.

    >>> list(_runs([True, True, False, True]))
    [(0, 2), (3, 4)]
    """
    first = None
    for index, flag in enumerate((*flags, False)):
        if flag and first is None:
            first = index
        elif not flag and first is not None:
            yield first, index
            first = None


def _is_straight(path: Sequence[Cell], index: int) -> bool:
    before, after = path[index - 1], path[index + 1]
    return before[0] == after[0] or before[1] == after[1]


def _between(one: Point, other: Point, share: float) -> Point:
    return one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1])


def _joined(parts: Iterable[tuple[Point, Point]]) -> Iterator[tuple[Point, Point]]:
    """Yield parts of a line; those that go on straight are joined."""
    last: tuple[Point, Point] | None = None
    for one, other in parts:
        if (
            last is not None
            and math.dist(last[1], one) < 1e-9
            and _same_heading(last, (one, other))
        ):
            last = last[0], other
            continue
        if last is not None:
            yield last
        last = one, other
    if last is not None:
        yield last


def _same_heading(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    (ax, ay), (bx, by) = ((end[0] - begin[0], end[1] - begin[1]) for begin, end in (one, other))
    return abs(ax * by - ay * bx) < 1e-9 and ax * bx + ay * by > 0
