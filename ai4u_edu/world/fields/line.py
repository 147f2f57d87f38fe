"""Lines on the ground that are generated from a seed."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from ai4u_edu.base.errors import WorldError
from ai4u_edu.base.parameters import Name, Point, PositiveMetres, quantity
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.descriptions import AreaDescription
from ai4u_edu.world.fields.field import (
    Cell,
    FieldBase,
    GeneratedField,
    direction_to,
    is_straight,
    moved,
)
from ai4u_edu.world.shapes import BoxShape

MAX_TRIES = 400
"""Lines that are begun before a description counts as impossible; one in two or three succeeds."""
MAX_SEARCH_STEPS = 600
"""Tiles that are tried for one of them."""
CURVE_PARTS = 4
"""Straight parts of a curve."""
GAP_SHARE = 0.4
"""Share of a tile that a gap takes."""


class LineBase(FieldBase):
    """The part that all fields with a line share: its width, its marks, and how it is drawn."""

    cell: PositiveMetres = 1.5
    """Side of a cell (m)."""
    curves: Annotated[float, quantity("1", ge=0, le=1)] = 0.5
    """Probability that the line tries to turn in a cell: 0 only where it has to, 1 where it can."""
    line_width: PositiveMetres = 0.25
    """Width of the line (m)."""
    goal: Name = "finish"
    """The body or area at its end."""
    marks: tuple[Name, ...] = ()
    """Areas of the scene that are put on the line at equal distances, in this order."""

    @model_validator(mode="after")
    def _line_has_room(self) -> Self:
        if self.line_width > self.cell / 3:
            raise ValueError(
                _(
                    "expected a line_width of at most a third of a cell ({cell:g} m), got "
                    "{line_width:g}",
                    cell=self.cell / 3,
                    line_width=self.line_width,
                )
            )
        return self

    def names(self) -> dict[str, str]:
        """Return start, goal and marks."""
        return {self.start: "start", self.goal: "goal"} | dict.fromkeys(self.marks, "marks")

    def painted(self, parts: Iterable[tuple[Point, Point]]) -> list[AreaDescription]:
        """Return the areas of a line's straight parts; those that go on straight are joined.

        Each is longer than its part: at a loose end by half the line's width, and in a bend just as
        far as its outer edge meets that of its neighbour, so that no corner sticks out.
        """
        joined = list(_joined(parts))
        bends = [math.pi, *(_bend(*pair) for pair in pairwise(joined)), math.pi]
        areas = []
        for number, ((one, other), around) in enumerate(
            zip(joined, pairwise(bends), strict=True), 1
        ):
            before, after = (
                self.line_width / 2 * min(1.0, math.tan(bend / 2)) / math.dist(one, other)
                for bend in around
            )
            begin, end = _between(one, other, -before), _between(one, other, 1 + after)
            areas.append(
                AreaDescription(
                    name=f"field line {number}",
                    shape=BoxShape(size=(math.dist(begin, end), self.line_width)),
                    position=((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2),
                    heading_deg=math.degrees(math.atan2(other[1] - one[1], other[0] - one[0])),
                    tags=("line",),
                    colour="black",
                    paint=True,
                )
            )
        return areas

    def parts_in(
        self, path: Sequence[Cell], index: int, *, has_gap: bool
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
        if index in (0, len(path) - 1) or is_straight(path, index):
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


class LineField(LineBase):
    """A line on the ground from one end to the other, which turns, crosses itself and has gaps.

    >>> line = LineField(width=8, height=6, length=20, crossings=1, gaps=1)
    >>> field = line.generate(np.random.default_rng(1))
    >>> {tag for piece in field.pieces for tag in piece.tags}, sorted(field.places)
    ({'line'}, ['finish', 'robot'])
    """

    type: Literal["line"] = "line"
    length: Annotated[int, Field(ge=3, le=200)] = 16
    """Number of cells through which the line goes; one that it crosses counts twice."""
    crossings: Annotated[int, Field(ge=0, le=10)] = 0
    """Number of times that the line crosses itself, at a right angle."""
    gaps: Annotated[int, Field(ge=0, le=20)] = 0
    """Number of gaps, in straight parts."""

    @model_validator(mode="after")
    def _has_room(self) -> Self:
        most = int(0.6 * self.width * self.height) - 4 * self.crossings
        if self.length > most:
            raise ValueError(
                _(
                    "expected a length of at most {most} cells in a field of {width} x {height} "
                    "with {crossings} crossings, got {length}",
                    most=most,
                    width=self.width,
                    height=self.height,
                    crossings=self.crossings,
                    length=self.length,
                )
            )
        least = 3 + 6 * self.crossings + 3 * self.gaps
        if self.length < least:
            raise ValueError(
                _(
                    "expected a length of at least {least} cells for {crossings} crossings and "
                    "{gaps} gaps, got {length}",
                    least=least,
                    crossings=self.crossings,
                    gaps=self.gaps,
                    length=self.length,
                )
            )
        return self

    def generate(self, rng: np.random.Generator) -> GeneratedField:
        """Return a line.

        Raises:
            WorldError: none of that kind was found.
        """
        for _try in range(MAX_TRIES):
            path = _LineSearch(self, rng).run()
            gaps = None if path is None else self._gaps(path, rng)
            if path is not None and gaps is not None:
                return self._built(path, gaps)
        raise WorldError(
            _(
                "found no line of {length} cells with {crossings} crossings and {gaps} gaps in "
                "{max_tries} tries; make it shorter, the field larger, or give it fewer curves",
                length=self.length,
                crossings=self.crossings,
                gaps=self.gaps,
                max_tries=MAX_TRIES,
            ),
            thing="generate",
        )

    def _gaps(self, path: Sequence[Cell], rng: np.random.Generator) -> set[int] | None:
        """Return the numbers of straight cells with a gap; None if there are too few."""
        found: set[int] = set()
        candidates = [
            index
            for index in range(2, len(path) - 2)
            if is_straight(path, index) and path.count(path[index]) == 1
        ]
        for index in rng.permutation(len(candidates)).tolist():
            place = candidates[index]
            if len(found) < self.gaps and not {place - 1, place + 1} & found:
                found.add(place)
        return found if len(found) == self.gaps else None

    def _built(self, path: Sequence[Cell], gaps: set[int]) -> GeneratedField:
        parts = (
            part
            for index in range(len(path))
            for part in self.parts_in(path, index, has_gap=index in gaps)
        )
        heading = 90.0 * direction_to(path[0], path[1])
        places: dict[str, tuple[Point, float | None]] = {
            self.start: (self.centre(path[0]), heading),
            self.goal: (self.centre(path[-1]), None),
        }
        for number, name in enumerate(self.marks, 1):
            index = round(number * (len(path) - 1) / (len(self.marks) + 1))
            # at a crossing, which the line passes twice, two marks could lie in one place
            while path.count(path[index]) > 1:
                index += 1
            places[name] = self.centre(path[index]), None
        return GeneratedField(tuple(self.painted(parts)), places)


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
        following = moved(self._path[-1], direction)
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
            following = moved(self._path[-1], each)
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


def _bend(one: tuple[Point, Point], other: tuple[Point, Point]) -> float:
    """Return the angle (rad) by which a line turns from a part to the next; pi if it has a gap."""
    if math.dist(one[1], other[0]) > 1e-9:
        return math.pi
    headings = [math.atan2(end[1] - begin[1], end[0] - begin[0]) for begin, end in (one, other)]
    return abs(math.remainder(headings[1] - headings[0], math.tau))
