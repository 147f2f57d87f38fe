"""Keeps a wall at its right hand, as in maze; goes for the exit when it sees it."""

from tests.scenes.solvers import Driver
from tests.scenes.solvers.maze import solver as keep_to_the_wall


def solver() -> Driver:
    return keep_to_the_wall()
