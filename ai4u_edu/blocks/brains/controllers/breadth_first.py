"""Breadth-first search, and a controller that uses it."""

from collections import deque
from collections.abc import Iterable

from ai4u_edu.blocks.brains.controllers.planner import (
    Cell,
    Found,
    Map,
    PlanController,
    neighbours,
    path_to,
)

__all__ = ["BreadthFirstController", "breadth_first"]


def breadth_first(free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
    """Find a shortest path to the nearest goal by breadth-first search.

    It keeps a frontier of cells that were seen but not visited yet, and visits them in the order in
    which they were seen: all cells one step away, then all that are two steps away, and so on. The
    first goal that it visits is a nearest one.

    Args:
        free: (rows, columns) True for cells that can be entered.
        start: the first cell of the path.
        goals: the cells where the path may end.

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
            return Found(path_to(cell, before), visited)
        for near in neighbours(free, cell):
            if near not in before:
                before[near] = cell
                border.append(near)
    return Found([], visited)


class BreadthFirstController(PlanController):
    """Takes the shortest path to the nearest goal, found by breadth-first search on the map.

    It needs a GridSensor (``grid``) for the map, a CellSensor (``cell``) for its cell in it, and a
    GridMoveActuator. It knows only the map, and avoids every code that is not in ``free``: in the
    grid world those of walls, persons and enemies. The search itself is the function
    ``breadth_first``, which takes any map.

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
        """Return a path from the start to the nearest goal."""
        return breadth_first(free, start, goals)
