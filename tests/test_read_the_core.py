"""The page "Read the core" and the ways through the code name files that belong together."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGE, ARCHITECTURE = (
    (ROOT / "docs" / name).read_text(encoding="utf-8")
    for name in ("read-the-core.md", "architecture.md")
)
SPINE = re.findall(r"^### \d+\. `(\S+)`$", PAGE, re.MULTILINE)
GIVEN = re.findall(r"^\| `(\S+)` \|", PAGE, re.MULTILINE)
WAYS: list[tuple[str, int, list[str]]] = [
    (title, int(count), re.findall(r"^\d+\. `(\S+?)`", text, re.MULTILINE))
    for title, count, text in re.findall(
        r"^### ([^\n]+): (\d+) files\n(.*?)(?=^##|\Z)",
        f"{PAGE}\n{ARCHITECTURE}",
        re.MULTILINE | re.DOTALL,
    )
]
MAX_FILES, MAX_LINES = 26, 6000
"""Limits of what is read in an afternoon; both may only fall."""


@pytest.mark.parametrize("path", SPINE)
def test_all_that_a_file_needs_is_read_or_taken_as_given(path: str) -> None:
    assert sorted(needed_by(path) - {*SPINE, *GIVEN}) == []


def test_everything_is_named_once_and_is_needed() -> None:
    paths = [*SPINE, *GIVEN]
    assert len(paths) == len(set(paths))
    assert sorted(set(GIVEN) - set().union(*map(needed_by, SPINE))) == []
    numbers = [int(number) for number in re.findall(r"^### (\d+)\. ", PAGE, re.MULTILINE)]
    assert numbers == list(range(1, len(SPINE) + 1))


def test_each_file_is_known_from_one_before_it() -> None:
    for index, path in enumerate(SPINE[1:], start=1):
        before = SPINE[:index]
        assert any(path in needed_by(each) for each in before) or needed_by(path) & {*before}, path


def test_it_stays_an_afternoon() -> None:
    lines = sum(len((ROOT / path).read_text(encoding="utf-8").splitlines()) for path in SPINE)
    assert (len(SPINE) <= MAX_FILES, lines <= MAX_LINES) == (True, True), (len(SPINE), lines)
    assert f"These {len(SPINE)} files" in PAGE


@pytest.mark.parametrize(("title", "count", "paths"), WAYS)
def test_a_way_is_as_long_as_it_says(title: str, count: int, paths: list[str]) -> None:
    assert len(paths) == len(set(paths)) == count, title
    joined = {paths[0]}
    for _ in paths:
        joined |= {path for path in paths if needed_by(path) & joined}
        joined |= {path for path in paths if any(path in needed_by(each) for each in joined)}
    assert sorted(set(paths) - joined) == [], f"{title}: these don't belong to the others"


def test_an_action_a_percept_a_check_and_a_join_have_their_ways() -> None:
    assert len(WAYS) == 4


# -- imports, followed through the packages that pass names on


def needed_by(path: str) -> set[str]:
    """Return the files of the package whose names a file imports, wherever in the file it does."""
    found = {
        file for module, name in _imported_names(ROOT / path) for file in _definers(module, name)
    }
    return {file for file in found if not file.endswith("__init__.py")} - {path}


@cache
def _module_path(name: str) -> Path | None:
    """Return the file of a module; None if there is no such module."""
    path = ROOT / Path(*name.split("."))
    files = path.with_suffix(".py"), path / "__init__.py"
    return next((file for file in files if file.is_file()), None)


@cache
def _imported_names(file: Path) -> tuple[tuple[str, str], ...]:
    """Return (module, name) of all that a file imports from the package."""
    return tuple(
        (node.module, alias.name)
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and node.module and _is_ours(node.module)
        for alias in node.names
    )


def _is_ours(module: str) -> bool:
    return module.partition(".")[0] == "ai4u_edu"


def _definers(module: str, name: str) -> Iterator[str]:
    """Yield the file that defines an imported name."""
    inner = _module_path(f"{module}.{name}")
    if inner is not None:
        yield str(inner.relative_to(ROOT))
        return
    file = _module_path(module)
    assert file is not None, module
    for origin, known in _imported_names(file) if file.name == "__init__.py" else ():
        if known == name or (known == "*" and name in _exports_of(origin)):
            yield from _definers(origin, name)
            return
    yield str(file.relative_to(ROOT))


@cache
def _exports_of(package: str) -> frozenset[str]:
    file = _module_path(package)
    assert file is not None, package
    return frozenset(known for _, known in _imported_names(file))
