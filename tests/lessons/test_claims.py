"""A lesson's claim is what happens: the counter-example is tried, and fails."""

import re
from pathlib import Path

import pytest

from ai4u_edu import CircleShape
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import lesson
from ai4u_edu.lessons.exercises import lesson_07
from ai4u_edu.lessons.exercises.lesson_21 import loads_home
from ai4u_edu.lessons.notebook import Cell
from tests.lessons.workbook import names_after_setup, run, tried

WEB = Path(__file__).parents[2] / "web"

COUNTER_EXAMPLES = {
    # "No rule can do this. It takes a memory."
    "06.2": (
        "whatever is more ahead",
        "turns slowly at a post until it looks at the other",
        "turns by a hair at a post, and reads the bearing as a clock",
        "changes the post by the clock",
        "rests by the clock",
    ),
    # "What does it have to remember?": bumps, and no time
    "06.3": ("by the clock", "by the clock, longer than any way"),
    # a state machine gets around walls that no curve gets around
    "07.1": ("a big arc", "an arc to the left", "an arc that turns while it bumps", "by the clock"),
    # the battery is read, and two numbers are needed
    "07.2": (
        "a rule with one number",
        "half of the time at the station",
        "more than half of the time at the station",
    ),
    # "Chase one that is still free."
    "16.1": ("one after the other, for 5 s each", "one after the other, for 10 s each"),
    # "It is the number that counts, not what sounds wise."
    "16.2": ("always back to the middle",),
    # a fair contest: the same games, and many of them
    "16.3": ("each plays other games", "the best game"),
    # luck does not look inside
    "18.2": ("takes turns", "whatever is more ahead", "food first, always", "water first, always"),
    # neither no exploration nor a little of it for ever will do
    "14.1": ("never", "always a little"),
    # two equally good methods never have the same mean
    "14.3": ("the larger mean", "no run may overlap"),
    # "What the numbers mean is not checked": by the network, but by the exercise
    "13.3": ("swapped codes", "angles left out"),
    # running at the ball is not enough, nor is running to the place behind it
    "17.4": ("runs at the ball", "pushes the ball on its way"),
    # "Which of the four tells orange from blue *and* from white?"
    "21.1": ("by brightness", "by red alone"),
    # "Only `heard` says whether somebody spoke."
    "21.3": ("takes silence for the middle", "asks whether x and y are 0"),
    # "Two robots share no variables; the tower has to *say* it."
    "21.4": ("a variable that both know",),
}
CASES = [
    pytest.param(exercise, name, id=f"{exercise} {name}")
    for exercise, names in COUNTER_EXAMPLES.items()
    for name in names
]


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AI4U_FAST", "1")


@pytest.mark.parametrize(("exercise", "name"), CASES)
def test_the_counter_example_fails(exercise: str, name: str) -> None:
    (answer,) = (each for each in answers_to(exercise).all if each.name == name)
    assert not tried(lesson(exercise[:2]), exercise, answer.code).passed


def test_attacking_wins_more_than_the_plan_that_sounds_wiser() -> None:
    (answer,) = (each for each in answers_to("16.2").all if each.name == "attacks")
    assert tried(lesson("16"), "16.2", answer.code).passed


def test_a_heading_can_stand_for_a_variable() -> None:
    # "Then its heading is its memory."
    (answer,) = (
        each for each in answers_to("07.2").all if each.name == "its heading is its memory"
    )
    assert tried(lesson("07"), "07.2", answer.code).passed


def test_without_ink_ants_bring_home_less_than_half() -> None:
    assert 0 < loads_home(has_ink=False) < loads_home(has_ink=True) / 2


def test_the_film_of_07_lasts_as_long_as_the_check(capsys: pytest.CaptureFixture[str]) -> None:
    (cell,) = (each for each in lesson("07").cells if "film(robot_in(wall_world" in each.source)
    assert f"limit={lesson_07.WALL_DECISIONS})" in cell.source
    names = names_after_setup(lesson("07"))
    run(Cell(answers_to("07.1").solution), names, "<answer>")
    run(cell, names, "<film>")
    assert "the robot reached its goal" in capsys.readouterr().out


def test_the_posts_of_06_have_their_colours_and_names() -> None:
    names = names_after_setup(lesson("06"))
    post = CircleShape(radius=0.5)
    world = names["room"](lambda _: {}, [], red=post, blue=post).world
    shown = {
        name: (world[name].description.colour, world[name].description.label)
        for name in ("red", "blue")
    }
    assert shown == {"red": ("vermillion", "red"), "blue": ("blue", "blue")}


@pytest.mark.parametrize("number", ["02", "08"])
def test_what_a_lesson_names_in_the_panel_is_there(number: str) -> None:
    (text,) = (cell.source for cell in lesson(number).cells if "**Details**" in cell.source)
    named = set(re.findall(r"\*\*(\w+)\*\*", text.partition("anel")[2]))
    page = "".join(path.read_text() for path in (WEB / "panel").rglob("*.js"))
    assert {"Details", "Action"} <= named
    assert {name for name in named if f'"{name}"' not in page} == set()


@pytest.mark.nightly  # trains a network
def test_a_learner_with_the_wrong_reward_lingers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AI4U_FAST")
    verdict = tried(lesson("10"), "10.4", answers_to("10.4").solution)
    assert verdict.passed, verdict.text


@pytest.mark.nightly  # trains two networks
def test_one_odd_drive_is_too_little_and_five_are_enough() -> None:
    one = next(each for each in answers_to("11.2").all if each.name == "one drive")
    assert not tried(lesson("11"), "11.2", one.code).passed
    assert tried(lesson("11"), "11.2", answers_to("11.2").solution).passed
