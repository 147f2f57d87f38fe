"""The README's programs run as they stand."""

import re
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.blocks.lesson_page import coming_from_ai4u
from tests.readme_table import between_marks

README = (Path(__file__).parents[1] / "README.md").read_text()


def test_python_blocks_run(capsys: pytest.CaptureFixture[str]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    names: dict[str, Any] = {}
    for block in blocks:
        exec(block, names)  # noqa: S102 - our own README
    assert len(blocks) == 2
    assert "'touch': 1.0" in capsys.readouterr().out
    assert names["DistanceTo"](target="box").reach == 20.0


def test_the_table_for_those_who_come_from_ai4u_is_the_codes_own() -> None:
    assert between_marks(README) == coming_from_ai4u()


def test_pictures_are_there() -> None:
    for path in re.findall(r"!\[.*?\]\((.*?)\)", README):
        assert (Path(__file__).parents[1] / path).is_file()
