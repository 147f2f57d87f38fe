"""The part that all generated fields share: cells, size, and the things that they place."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from ai4u_edu.base.parameters import Name, Point, PositiveMetres
from ai4u_edu.world.descriptions import AreaDescription, BodyDescription, FloorDescription
from ai4u_edu.world.shapes import Description

Thing = BodyDescription | FloorDescription | AreaDescription
Cell = tuple[int, int]
"""Column and row, from the lower left corner."""
Rectangle = tuple[Point, Point]

EAST, NORTH, WEST, SOUTH = range(4)
STEPS: tuple[Cell, ...] = (1, 0), (0, 1), (-1, 0), (0, -1)
"""Steps to the neighbours, by direction."""


@dataclass(frozen=True)
class GeneratedField:
    """A field as generated for one episode."""

    pieces: tuple[Thing, ...]
    """New things, which no scene file names."""
    places: Mapping[str, tuple[Point, float | None]]
    """Position, and heading (degrees) where the field decides it, of things in the scene."""
    blocked: tuple[Point, ...] = ()
    """Centres of cells in which nothing else has room."""


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

    def room(self) -> float | None:
        """Return how far (m) a body may reach in the middle of a cell; None if nothing is there."""
        return None

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


def neighbours(cell: Cell) -> list[Cell]:
    """Return the four cells around one, which may lie outside the field."""
    return [moved(cell, direction) for direction in range(4)]


def moved(cell: Cell, direction: int) -> Cell:
    """Return the neighbour of a cell in a direction, of which 4 are a whole turn."""
    return cell[0] + STEPS[direction % 4][0], cell[1] + STEPS[direction % 4][1]


def direction_to(one: Cell, other: Cell) -> int:
    """Return the direction from a cell to its neighbour."""
    return STEPS.index((other[0] - one[0], other[1] - one[1]))


def is_straight(path: Sequence[Cell], index: int) -> bool:
    """Return True if a path goes straight on through its cell of that number."""
    before, after = path[index - 1], path[index + 1]
    return before[0] == after[0] or before[1] == after[1]
