"""The README's programs run as they stand."""

import re
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.blocks.lesson_page import coming_from_ai4u
from tests.playing import played
from tests.readme_table import between_marks

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


def test_the_table_for_those_who_come_from_ai4u_is_the_codes_own() -> None:
    assert between_marks(README) == coming_from_ai4u()


def test_pictures_are_there() -> None:
    for path in re.findall(r"!\[.*?\]\((.*?)\)", README):
        assert (Path(__file__).parents[1] / path).is_file()
