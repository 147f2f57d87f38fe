"""Exercises without code: sliders and cards, pressed as a student does."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons import cards, controls, filming, notebook_output, sliders
from ai4u_edu.lessons.controls import Controls
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.lessons.time_limit import TimeLimit

pytestmark = pytest.mark.needs("lessons")

widgets: Any = pytest.importorskip("ipywidgets")


@pytest.fixture(autouse=True)
def said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Words that are shown under the cell; progress goes to a folder of its own."""
    monkeypatch.chdir(tmp_path)
    texts: list[str] = []
    for module in (notebook_output, controls, filming):
        monkeypatch.setattr(module, "put", lambda page, words: texts.append(words))
    yield texts
    widgets.Widget.close_all()


def wheels(left: float, right: float) -> Any:
    return lambda percept: {
        "wheels": [
            left * percept["left eye"][0] + right * percept["right eye"][0],
            left * percept["right eye"][0] + right * percept["left eye"][0],
        ]
    }


def found(panel: Any, kind: str) -> list[Any]:
    """Return the widgets of a class within a panel."""
    inside = [each for child in getattr(panel, "children", ()) for each in found(child, kind)]
    return [panel, *inside] if type(panel).__name__ == kind else inside


def press(panel: Any, name: str) -> None:
    (button,) = (each for each in found(panel, "Button") if each.description == name)
    button.click()
    assert not button.disabled


def vehicle(
    make: Any = wheels, preview: Any = None, *, low: float = -1, switches: bool = False
) -> Any:
    ranges = {"left": (low, 1), "right": (-1.0, 1.0)}
    return Controls("05.2", make, preview, ranges, has_switches=switches).panel


def test_the_numbers_of_the_sliders_are_filmed_and_checked(said: list[str]) -> None:
    panel = vehicle()
    left, _ = found(panel, "FloatSlider")
    assert (left.description, left.min, left.max, left.value) == ("left", -1, 1, 0)
    press(panel, "Check")
    assert said[0].startswith("Not yet. The vehicle stands still")
    left.value = 1
    press(panel, "Try")
    assert said[1].startswith("Seed ")
    assert "after 300 decisions the film stops" in said[1]
    assert ProgressFile().entries()["05.2"].tries == 1
    press(panel, "Check")
    assert said[2].startswith("\u2714 Right. In 12 worlds it turned its back")
    entry = ProgressFile().entries()["05.2"]
    assert entry.passed
    assert entry.code == "# set with sliders or cards: left=1, right=0"


def test_a_card_that_is_off_is_left_out_of_the_call() -> None:
    calls: list[dict[str, float]] = []

    def make(**numbers: float) -> Any:
        calls.append(numbers)
        return lambda percept: {"wheels": [0, 0]}

    panel = vehicle(make, low=0, switches=True)
    switches, (left, right) = found(panel, "Checkbox"), found(panel, "FloatSlider")
    assert (left.value, right.value) == (0.5, 0.0)  # a card that is switched on does something
    assert [each.description for each in switches] == ["left", "right"]
    press(panel, "Try")
    assert left.disabled
    switches[1].value = True
    assert (left.disabled, right.disabled) == (True, False)
    right.value = -0.3
    press(panel, "Try")
    switches[1].value = False
    press(panel, "Try")
    assert calls == [{}, {"right": -0.3}, {}]


def test_a_preview_shows_it_or_gives_a_world_to_film(said: list[str]) -> None:
    given: list[Any] = []
    press(vehicle(preview=given.append), "Try")
    assert [callable(each) for each in given] == [True]
    assert said == []
    press(vehicle(preview=lambda wires: Scene.load("box_chase").build()), "Try")
    assert said[0].startswith("Seed 0: after ")


def test_an_exercise_without_a_world_has_nothing_to_film(said: list[str]) -> None:
    panel = Controls("02.1", lambda a: lambda d, s: a, None, {"a": (0, 9)}, has_switches=False)
    press(panel.panel, "Try")
    assert said == [controls.NOTHING_TO_FILM]


def broken(left: float, right: float) -> Any:
    return 1 / left


def endless(left: float, right: float) -> Any:
    while True:
        pass


@pytest.mark.parametrize("button", ["Try", "Check"])
def test_a_mistake_in_make_is_a_sentence(
    said: list[str], button: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    press(vehicle(broken), button)
    assert said[0].startswith("Stopped. Your code stopped with ZeroDivisionError: float division")
    monkeypatch.setattr("ai4u_edu.lessons.controls.TimeLimit", lambda: TimeLimit(0.4))
    press(vehicle(endless), button)
    assert "while True" in said[1]
    assert ProgressFile().entries() == {}


def test_without_a_notebook_or_ipywidgets_a_sentence_says_so(
    said: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    sliders("05.2", wheels, left=(-1, 1), right=(-1, 1))
    assert said == ["05.2: left, right can be set in JupyterLab."]
    monkeypatch.setattr(controls, "has", lambda *modules: False)
    cards("05.2", wheels, left=(-1, 1))
    assert said[1] == f"No sliders. {controls.MISSING}"


def test_a_range_without_a_length_and_an_unknown_exercise_are_told() -> None:
    with pytest.raises(SetupError, match=r"left: expected \(lowest, highest\), got \(1, 1\)"):
        sliders("05.2", wheels, left=(1, 1))
    with pytest.raises(SetupError, match="no exercise is called"):
        cards("04.9", wheels, left=(0, 1))
