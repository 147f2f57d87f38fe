"""Goals that a program can reach in a scene of the library, one star each."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ai4u_edu.scenes.description import SceneDescription
from ai4u_edu.scenes.scene import LIBRARY, Scene

_FIELD = re.compile(r"^(\w+):", re.MULTILINE)


@dataclass(frozen=True)
class StarGoals:
    """The goals of a scene: reach it once; from ten unseen starts; and in few decisions."""

    count: int
    """0 in a scene without ``success``, 2 where the goal takes a fixed time, or 3."""
    few_decisions: int | None
    """Most decisions for the third star, on average over the ten starts."""


def star_goals(description: SceneDescription) -> StarGoals:
    """Return the goals of a scene.

    >>> star_goals(Scene.load("forage").description)
    StarGoals(count=2, few_decisions=None)
    """
    few = description.few_decisions
    count = 0 if description.success is None else 2 if few is None else 3
    return StarGoals(count, few if count else None)


def library_star_goals(description: SceneDescription) -> StarGoals | None:
    """Return the goals of a scene of the library; None for another scene, or a changed one.

    Stars are kept by a scene's name, and an easier world of that name must not earn them.
    """
    name = description.name
    if name not in Scene.names() or description != _in_library(name):
        return None
    return star_goals(description)


@cache
def library_star_counts() -> Mapping[str, int]:
    """Return the number of stars of each scene of the library.

    Fields at the left margin are all that it reads: to load all scenes takes a second.
    """
    texts = {name: (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8") for name in Scene.names()}
    fields = {name: set(_FIELD.findall(text)) for name, text in texts.items()}
    return {
        name: 0 if "success" not in each else 3 if "few_decisions" in each else 2
        for name, each in fields.items()
    }


@cache
def _in_library(name: str) -> SceneDescription:
    return Scene.load(name).description
