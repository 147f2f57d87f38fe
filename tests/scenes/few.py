"""The scenes that a test of all scenes takes in each run; at night it takes the others, too."""

import pytest

from ai4u_edu import Scene

FEW = ("box_chase", "grid_world", "maze", "parking", "sumo")
"""Scenes that differ most: a box to push, cells, walls and rays, a car, two agents."""


def mostly_nightly(names: list[str]) -> list[object]:
    """Return the names of scenes as parameters of a test; all but :data:`FEW` are nightly."""
    return [
        name if name in FEW else pytest.param(name, marks=pytest.mark.nightly) for name in names
    ]


SCENES = mostly_nightly(Scene.names())
