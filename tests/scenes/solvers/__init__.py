"""Solvers of the scenes, each a few lines that see only what the agent senses.

One module a scene, by the scene's name; its ``solver()`` makes a driver for one episode.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any, cast

from ai4u_edu import Percept

Driver = Callable[[Percept], Mapping[str, Any]]


def solver_of(scene: str) -> Driver:
    """A new driver that solves a scene."""
    return cast(Driver, import_module(f"tests.scenes.solvers.{scene}").solver())
