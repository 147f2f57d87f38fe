"""The solver of box_chase; only the starts differ."""

from tests.scenes.solvers.box_chase import solver

__all__ = ["solver"]
