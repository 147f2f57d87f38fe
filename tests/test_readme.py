"""The README's programs run as they stand."""

import re
from pathlib import Path
from typing import Any

import pytest

import ai4u_edu
from tests.builders import small_sim
from tests.components import AI4U, AI4U_SETTINGS
from tests.names import readme_table
from tests.playing import played

README = (Path(__file__).parents[1] / "README.md").read_text()


def test_python_blocks_run(capsys: pytest.CaptureFixture[str]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    names: dict[str, Any] = {}
    with played("box_chase", "--time-scale", "10") as game:
        for block in blocks:
            exec(block.replace("http://127.0.0.1:8080", game.url), names)  # noqa: S102 - our own
    assert len(blocks) == 4
    told = capsys.readouterr().out
    assert "'touch': 1.0" in told
    assert names["DistanceTo"](target="box").reach == 20.0
    assert "(126,) {'touch': 0.0" in told
    assert "['blue_striker', 'blue_keeper', 'orange_striker'" in told
    assert "the robot is done: {'touch': 100.0" in told


def test_every_class_of_ai4u_has_a_row_that_says_something() -> None:
    rows = [line.split(" | ") for line in readme_table(README).splitlines()[2:]]
    assert [row[0].strip("|` ") for row in rows] == sorted(AI4U.split(), key=str.lower)
    assert all(len(row[2].split()) > 2 for row in rows)


def test_every_setting_of_ai4u_has_a_row() -> None:
    named = {name for theirs, _ in settings() for name in re.findall(r"`([^`]+)`", theirs)}
    assert {each.replace("_FPS", " FPS") for each in AI4U_SETTINGS.split()} - named == set()


def test_what_the_rows_name_is_here() -> None:
    named = [name for _, here in settings() for name in re.findall(r"`([\w.]+)`", here)]
    assert len(named) > 70
    strange = [name for name in named if not is_known(name)]
    assert strange == []


def settings() -> list[tuple[str, str]]:
    """The table of methods and settings: AI4U's names, and what stands for them."""
    table = README.split("Methods and settings:")[1].split("\n## ")[0]
    return re.findall(r"^\| (`.*?) \| (.*?) \|$", table, re.MULTILINE)


def is_known(name: str) -> bool:
    """Whether there is such a class, attribute, parameter, event or method."""
    owner, _, member = name.rpartition(".")
    if owner == "BasicAgent":
        return hasattr(small_sim().agents[0], member)
    if owner:
        cls = getattr(ai4u_edu, owner)
        return hasattr(cls, member) or (owner != "Command" and member in cls.parameters())
    return name in {*dir(ai4u_edu), *ai4u_edu.EVENTS, *WORDS}


WORDS = {"Box", "Discrete", "handler", "default_time_scale"} | {
    f"__{each}__" for each in ("restart", "pause", "resume", "stop")
}
"""What stands in the rows and is not a name of the package."""


def test_pictures_are_there() -> None:
    for path in re.findall(r"!\[.*?\]\((.*?)\)", README):
        assert (Path(__file__).parents[1] / path).is_file()
