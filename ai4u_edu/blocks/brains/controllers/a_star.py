"""A* search, and a controller that uses it."""

from collections.abc import Iterable
from heapq import heappop, heappush

from ai4u_edu.blocks.brains.controllers.planner import (
    Cell,
    Found,
    Map,
    PlanController,
    neighbours,
    path_to,
)

__all__ = ["AStarController", "a_star"]


def a_star(free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
    """Find a shortest path to the nearest goal by A*.

    It visits the cell of the frontier with the smallest estimate first: the steps taken so far plus
    those that would remain without walls. This estimate is never too large (it is admissible), so
    the path is a shortest one, and breadth-first search can't do with fewer cells. Source: P. Hart,
    N. Nilsson and B. Raphael, 1968.

    Args:
        free: (rows, columns) True for cells that can be entered.
        start: the first cell of the path.
        goals: the cells where the path may end.

    >>> import numpy as np
    >>> from ai4u_edu import breadth_first
    >>> free = np.ones((9, 9), bool)
    >>> for search in (breadth_first, a_star):
    ...     way, visited = search(free, (4, 0), [(4, 6)])
    ...     print(len(way), "cells long, visited", len(visited))
    7 cells long, visited 35
    7 cells long, visited 7
    """
    ends = sorted(set(goals))
    steps, before = {start: 0}, {start: start}
    border = [(distance(start, ends), 0, start)]
    visited: list[Cell] = []
    while border:
        _, left_behind, cell = heappop(border)
        if -left_behind > steps[cell]:
            continue  # a shorter path to it was found since
        visited.append(cell)
        if cell in ends:
            return Found(path_to(cell, before), visited)
        for near in neighbours(free, cell):
            taken = steps[cell] + 1
            if taken < steps.get(near, taken + 1):
                steps[near], before[near] = taken, cell
                # of equal estimates, the cell with more steps taken comes first
                heappush(border, (taken + distance(near, ends), -taken, near))
    return Found([], visited)


def distance(cell: Cell, goals: Iterable[Cell]) -> int:
    """Return the steps to the nearest goal without walls; 0 if there is no goal."""
    return min((abs(cell[0] - row) + abs(cell[1] - column) for row, column in goals), default=0)


class AStarController(PlanController):
    """Takes the shortest path to the nearest goal, found by A* with fewer visited cells.

    It needs the same blocks as a BreadthFirstController, and its paths have the same length. It
    searches towards the goal first, so it visits fewer cells (``found.visited``). The search itself
    is the function ``a_star``, which takes any map.

    Source: ours, for the lessons on search of AI4U's grid world.
    """

    def search(self, free: Map, start: Cell, goals: Iterable[Cell]) -> Found:
        """Return a path from the start to the nearest goal."""
        return a_star(free, start, goals)
