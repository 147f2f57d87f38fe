"""Refuse imports of packages that some extras of pyproject.toml don't bring.

An environment adds up what was ever installed into it, and would hide that a test needs more than
its tier promises.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from types import ModuleType

from packaging.requirements import Requirement

INSTALLERS = {"pip", "setuptools", "wheel"}
"""Packages of a new environment."""


class OnlyExtras(PathFinder):
    """Python's finder of modules, which finds none of other packages.

    Whoever imports such a module gets an error with advice; whoever only asks whether it is there,
    by ``importlib.util.find_spec``, gets None, as where it is not installed.

    Args:
        extras: of this project.
    """

    def __init__(self, extras: set[str]) -> None:
        self._extras = ", ".join(sorted(extras))
        allowed = set(_brought("ai4u-edu", frozenset(extras), set())) | INSTALLERS
        self.refused = frozenset(
            module
            for module, packages in packages_distributions().items()
            if not allowed & set(map(_normal, packages))
        )
        """Names of the refused top-level modules."""

    def install(self) -> None:
        """Refuse from now on what was not imported yet."""
        sys.meta_path[sys.meta_path.index(PathFinder)] = self

    def find_spec(  # type: ignore[override]  # a class method there; this is an object
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return None or raise an error for a refused module; find all others.

        Raises:
            ModuleNotFoundError: the module comes with other extras.
        """
        if name.partition(".")[0] not in self.refused:
            return PathFinder.find_spec(name, path, target)
        if sys._getframe(2).f_globals["__name__"] == "importlib.util":
            return None
        raise ModuleNotFoundError(
            f"No module named {name!r} among the packages of [{self._extras}]; mark the test "
            "with the extra that it needs: pytest.mark.needs(...)",
            name=name,
        )


def _brought(
    package: str, extras: frozenset[str], seen: set[tuple[str, frozenset[str]]]
) -> Iterator[str]:
    """Yield the names of a package and of all that it requires with some extras."""
    if (package, extras) in seen:
        return
    seen.add((package, extras))
    try:
        requirements = requires(package) or []
    except PackageNotFoundError:  # of another platform
        return
    yield package
    for text in requirements:
        one = Requirement(text)
        if one.marker is None or any(
            one.marker.evaluate({"extra": extra}) for extra in extras or {""}
        ):
            yield from _brought(_normal(one.name), frozenset(one.extras), seen)


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
