"""A lesson's claim is what happens: the counter-example is tried, and fails."""

from pathlib import Path

import pytest

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import lesson
from tests.lessons.workbook import tried

COUNTER_EXAMPLES = {
    # "No rule can do this. It takes a memory."
    "06.2": ("whatever is more ahead", "turns slowly at a post until it looks at the other"),
    # a state machine gets around walls that no curve gets around
    "07.1": ("a big arc", "an arc to the left", "an arc that turns while it bumps"),
    # "It is the number that counts, not what sounds wise."
    "16.2": ("always back to the middle",),
    # a fair contest: the same games, and many of them
    "16.3": ("each plays other games", "the best game"),
    # luck does not look inside
    "18.2": ("takes turns", "whatever is more ahead"),
    # neither no exploration nor a little of it for ever will do
    "14.1": ("never", "always a little"),
    # two equally good methods never have the same mean
    "14.3": ("the larger mean", "no run may overlap"),
    # "What the numbers mean is not checked": by the network, but by the exercise
    "13.3": ("swapped codes", "angles left out"),
    # running at the ball is not enough, nor is running to the place behind it
    "17.4": ("runs at the ball", "pushes the ball on its way"),
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
