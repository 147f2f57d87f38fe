"""Plots have the worlds' colours, and are told apart without them."""

import io
import math
from typing import Any

import numpy as np
import pytest
from PIL import Image

from ai4u_edu.base.colors import PALETTE, rgb
from ai4u_edu.lessons import bars, plot, plots
from ai4u_edu.lessons.student_errors import mistake_in

pytestmark = pytest.mark.needs("lessons")


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    pictures: list[bytes] = []

    def image(data: bytes, alt: str) -> str:
        pictures.append(data)
        return alt

    monkeypatch.setattr(plots, "image", image)
    return pictures


def colours(picture: bytes) -> set[tuple[int, ...]]:
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).reshape(-1, 3)
    return {tuple(int(each) for each in row) for row in np.unique(pixels, axis=0)}


def test_lines_are_in_the_colours_of_the_palette(
    drawn: list[bytes], capsys: pytest.CaptureFixture[str]
) -> None:
    plot({"a": [1, 2, 3], "b": [3, 2, 1]}, xlabel="x (m)", title="two")
    assert {rgb("blue"), rgb("orange")} <= colours(drawn[0])
    assert capsys.readouterr().out == "[plot] two: a from 1 to 3; b from 3 to 1\n"


def test_bars_say_their_heights(drawn: list[bytes], capsys: pytest.CaptureFixture[str]) -> None:
    bars({"touch": 10.0, "fall": -1.0}, title="paid")
    assert rgb("sky blue") in colours(drawn[0])
    assert capsys.readouterr().out == "paid: {'touch': 10.0, 'fall': -1.0}\n"


def test_no_two_lines_are_told_apart_by_colour_alone() -> None:
    looks = [
        (plots.STYLES[n % len(plots.STYLES)], plots.MARKERS[n % len(plots.MARKERS)])
        for n in range(len(plots.COLOURS))
    ]
    assert len(set(looks)) == len(plots.COLOURS) == len(set(plots.COLOURS) & set(PALETTE))


def test_an_exception_of_nobodys_code_tells_nothing() -> None:
    assert mistake_in(ValueError("never raised")) is None


@pytest.mark.parametrize("empty", [{}, {"a": []}])
def test_nothing_to_draw_is_no_trouble(drawn: list[bytes], empty: dict[str, Any]) -> None:
    plot(empty)
    assert len(drawn) == 1


@pytest.mark.parametrize(
    "heights",
    [{}, {"a": 0.0}, {"a": math.nan, "b": 1.0}, {"a": math.inf, "b": -math.inf}, {"$a$_$": -1.0}],
)
def test_bars_of_anything(heights: dict[str, float]) -> None:
    bars(heights, title="paid")


@pytest.mark.parametrize(
    "lines", [{}, {"a": []}, {"a": [math.nan]}, {"a": [1.0, math.inf]}, {"$a$_$": [1.0], "b": []}]
)
def test_lines_of_anything(lines: dict[str, list[float]]) -> None:
    plot(lines, title="paid")
