"""Search that looks everywhere, near places first."""

from collections import deque
from collections.abc import Iterable

from ai4u_edu.blocks.brains.controllers.planner import (
    Cell,
    Found,
    Map,
    PlanController,
    neighbours,
    way_to,
)

__all__ = ["BreadthFirstController", "breadth_first"]


def breadth_first(free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
    """A shortest way to the nearest goal, by breadth-first search.

    It keeps a border of cells that it has seen but not looked at yet, and takes first what it saw
    first. So it looks at all cells one step away, then at all that are two steps away, and so on:
    the first goal that it meets is a nearest one.

    Args:
        free: (rows, columns) where one can go.
        start: where the way begins.
        goals: where it may end.

    >>> import numpy as np
    >>> free = np.array([[1, 1, 1], [1, 0, 1]], bool)
    >>> breadth_first(free, (1, 0), [(1, 2)]).way
    [(1, 0), (0, 0), (0, 1), (0, 2), (1, 2)]
    """
    ends = set(goals)
    border = deque([start])
    before = {start: start}
    visited = []
    while border:
        cell = border.popleft()
        visited.append(cell)
        if cell in ends:
            return Found(way_to(cell, before), visited)
        for near in neighbours(free, cell):
            if near not in before:
                before[near] = cell
                border.append(near)
    return Found([], visited)


class BreadthFirstController(PlanController):
    """Goes the shortest way to the nearest goal, which breadth-first search finds on the map.

    It needs a GridSensor (``grid``) for the map, a CellSensor (``cell``) for its place in it, and a
    GridMoveActuator. It knows only what the map shows, and keeps off every code that is not in
    ``free``: in the grid world those of walls, persons and enemies. The search itself is the
    function ``breadth_first``, which takes any map.

    Source: ours, for the lessons on search of AI4U's grid world.

    >>> from ai4u_edu import BreadthFirstController, ControlRequestor, LocalBrain, Scene
    >>> sim = Scene.load("grid_world").build()
    >>> robot = sim.agents[0]
    >>> robot.use_brain(LocalBrain(controller=BreadthFirstController(), skip_frame=9))
    >>> sim.reset(seed=1)
    >>> while not robot.done:
    ...     percept = sim.step()
    >>> robot.ledger.episode_terms["all_clean"]
    10.0
    """

    def search(self, free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
        """A way from the start to the nearest goal."""
        return breadth_first(free, start, goals)
