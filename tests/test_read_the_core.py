"""The page "Read the core" names files that are there, all that they need, in an order."""

import re

import pytest

from tests.imports import ROOT, needed_by

PAGE = (ROOT / "docs" / "read-the-core.md").read_text(encoding="utf-8")
SPINE = re.findall(r"^### \d+\. `(\S+)`$", PAGE, re.MULTILINE)
GIVEN = re.findall(r"^\| `(\S+)` \|", PAGE, re.MULTILINE)
WAYS: list[tuple[str, int, list[str]]] = [
    (title, int(count), re.findall(r"^\d+\. `(\S+)`$", text, re.MULTILINE))
    for title, count, text in re.findall(
        r"^### ([^\n]+): (\d+) files\n(.*?)(?=^###|\Z)", PAGE, re.MULTILINE | re.DOTALL
    )
]
MAX_FILES, MAX_LINES = 26, 5200
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


def test_there_are_three_ways() -> None:
    assert len(WAYS) == 3
