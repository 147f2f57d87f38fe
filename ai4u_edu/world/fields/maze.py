"""Mazes that are generated from a seed."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from ai4u_edu.base.parameters import Name, Point, PositiveMetres, quantity
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.fields.field import Cell, FieldBase, GeneratedField, direction_to, neighbours
from ai4u_edu.world.shapes import BoxShape


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
                _(
                    "expected walls of at most half a cell ({cell:g} m), got {wall:g}",
                    cell=self.cell / 2,
                    wall=self.wall,
                )
            )
        return self

    def margin(self) -> float:
        """Return half a wall."""
        return self.wall / 2

    def room(self) -> float:
        """Return half of what the walls leave of a cell."""
        return (self.cell - self.wall) / 2

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
        heading = 90.0 * direction_to(start, min(ways[start]))
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
            free = [each for each in neighbours(here) if each in ways and each not in reached]
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
            for each in neighbours(cell)
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
