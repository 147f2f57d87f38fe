"""Breadth-first search on the map, to the nearest dirty place."""

from collections import deque
from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver

FLOOR, DIRTY = 1, 200
STEPS = {1: (0, 1), 2: (0, -1), 3: (-1, 0), 4: (1, 0)}


def first_step(grid: Any, start: tuple[int, int]) -> int:
    """The first step of a shortest way; 0 where there is none."""
    border = deque([(start, 0)])
    seen = {start}
    while border:
        (row, column), first = border.popleft()
        if grid[row, column] == DIRTY:
            return first
        for choice, (down, right) in STEPS.items():
            cell = row + down, column + right
            if cell not in seen and grid[cell] in (FLOOR, DIRTY):
                seen.add(cell)
                border.append((cell, first or choice))
    return 0


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        row, column = percept["cell"].tolist()
        return {"move": first_step(percept["grid"], (row, column))}

    return drive
