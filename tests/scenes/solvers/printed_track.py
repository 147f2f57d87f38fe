"""Steers by where the printed line is under its row of eyes; off it, to where it was last seen."""

from tests.scenes.solvers import Driver
from tests.scenes.solvers.line_follow import solver as line_follower


def solver() -> Driver:
    return line_follower()
