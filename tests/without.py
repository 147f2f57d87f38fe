"""Refuse imports of packages, as if their folders were deleted.

For a process of its own: ``python -c "from tests.without import refuse; refuse('viser'); ..."``.
"""

import importlib.abc
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from types import ModuleType

OPTIONS = {
    "explain": ["ai4u_edu.explain"],
    "games": ["ai4u_edu.games"],
    "learn": ["ai4u_edu.learn"],
    "lessons": ["ai4u_edu.lessons"],
    "missions": ["ai4u_edu.missions"],
    "program": ["ai4u_edu.program"],
    "teach": ["ai4u_edu.teach"],
}
"""Packages of each option."""
STEPS = """
from ai4u_edu.learn.envs import SceneEnv
env = SceneEnv("box_chase")
env.reset(seed=1)
env.step(env.action_space.sample())
"""
"""Program that steps an environment."""
ACT = """
from ai4u_edu.remote import connect
with connect({url!r}, agent="0", patience=180) as robot:
    robot.act(move=[1, 0, 0, 0])
    print("done" in robot.sense())
"""
"""Program that drives a robot at an address."""


class Refusal(importlib.abc.MetaPathFinder):
    """Finder of modules that raises an error for those of some packages.

    Args:
        packages: their full names.
    """

    def __init__(self, packages: Sequence[str]) -> None:
        self._packages = packages

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Raise an error for a refused module, and leave all others to the next finder.

        Raises:
            ModuleNotFoundError: the module is one of a refused package.
        """
        if any(f"{name}.".startswith(f"{package}.") for package in self._packages):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        return None


def refuse(*packages: str) -> None:
    """Refuse from now on the packages of these names, none of which is loaded yet."""
    loaded = sorted({*packages} & {*sys.modules})
    assert not loaded, f"expected to refuse them before they are imported: {loaded}"
    sys.meta_path.insert(0, Refusal(packages))


def code_without(packages: Sequence[str], code: str) -> str:
    """Return a program that runs some code without packages."""
    return f"from tests.without import refuse\nrefuse(*{packages!r})\n{code}"
