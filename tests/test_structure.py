"""The structure of the package, held to figures that may only get better."""

import itertools
from pathlib import Path

import pytest

from tests.structure import PROGRAMS, STARTS, Structure, figures, limits, loaded_by

SMALL = {
    "small/__init__.py": "",
    "small/top/__init__.py": "",
    "small/top/start.py": """
from typing import TYPE_CHECKING
if TYPE_CHECKING:
    from small.low import types
def run(number):
    from importlib import import_module
    from small.top import helper
    import_module(f"small.options.option_{number}")
class Same: ...
""",
    "small/top/helper.py": "from small.low import left\nclass Same: ...",
    "small/low/__init__.py": "",
    "small/low/left.py": "import small.low.right",
    "small/low/right.py": "def back():\n    from small.low import left",
    "small/low/types.py": "import small.low.left\nimport small.top.start",
    "small/options/__init__.py": "",
    "small/options/option_1.py": "",
    "small/options/option_2.py": "",
    "small/options/other.py": "",
}
"""A package whose figures can be counted by hand."""


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure()


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Structure:
    for name, text in SMALL.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    return Structure("small", tmp_path)


def test_no_figure_is_worse_than_its_limit_and_no_limit_is_slack(structure: Structure) -> None:
    measured = figures(structure)
    worse = {name: limit for name, limit in limits().items() if measured[name] > limit}
    assert not worse, "see which modules they are: python -m tests.structure --list"
    slack = {name: limit for name, limit in limits().items() if measured[name] < limit}
    assert not slack, "better than the limit: write it with python -m tests.structure --write"


def test_a_closure_has_imports_in_functions_and_names_given_to_import_module(
    small: Structure,
) -> None:
    assert small.closure("small.top.start") == {
        "small",
        "small.low",
        "small.low.left",
        "small.low.right",
        "small.options",
        "small.options.option_1",
        "small.options.option_2",
        "small.top",
        "small.top.helper",
        "small.top.start",
    }


def test_circles_through_functions_and_through_types_are_told_apart(small: Structure) -> None:
    assert small.circles == [["small.low.left", "small.low.right"]]
    assert small.circles_of_types == [["small.low.types", "small.top.start"]]


def test_arrows_floors_and_single_importers_are_counted(small: Structure) -> None:
    assert small.arrows == {("top", "low"), ("low", "top")}
    assert small.upward([["top"], ["low"]]) == {("low", "top")}
    assert small.upward([["options"], ["top", "low"]]) == small.arrows
    assert small.single_importers == ["small.low.right", "small.top.helper"]
    assert small.repeated_classes == ["Same"]


@pytest.mark.slow
@pytest.mark.parametrize("start", PROGRAMS)
def test_what_a_program_really_loads_lies_in_its_closure(structure: Structure, start: str) -> None:
    doors = itertools.chain.from_iterable(
        structure.closure(name) for name in ("ai4u_edu", STARTS[start])
    )
    assert loaded_by(PROGRAMS[start]) & structure.modules <= set(doors)
