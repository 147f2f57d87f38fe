"""Helpers that notebooks call: paths without code, and the dialogue with a RemoteBrain."""

import itertools
from pathlib import Path

import pytest

from ai4u_edu import RemoteBrain
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.links.ai4u import AI4ULink
from ai4u_edu.lessons.checking import judge
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.exercises import lesson_15
from ai4u_edu.lessons.exercises.lesson_11_choice import clone_of, conditions, last_drives
from ai4u_edu.lessons.exercises.lesson_12 import two_neurons
from ai4u_edu.lessons.exercises.lesson_15 import overheard
from ai4u_edu.lessons.filming import film_check
from tests.waiting import LIMIT_S


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("chosen", "passes"),
    [({"reached": 1}, True), ({"reached": 0}, False), ({"min_seconds": 1.5}, False), ({}, False)],
)
def test_conditions_without_code_choose_drives(chosen: dict[str, float], passes: bool) -> None:
    assert judge(find("11.1"), conditions(**chosen)).passed is passes


@pytest.mark.parametrize(("turn", "passes"), [(-5.0, True), (5.0, False)])
def test_the_six_numbers_of_the_sliders_drive(turn: float, passes: bool) -> None:
    neurons = two_neurons(
        forward_sine=0,
        forward_cosine=0,
        forward_bias=1,
        turn_sine=turn,
        turn_cosine=0,
        turn_bias=0,
    )
    assert judge(find("12.2"), neurons).passed is passes


def test_the_drives_to_choose_from_are_good_ones_and_a_fall() -> None:
    assert sorted(bool(each.success) for each in last_drives()) == [False, *[True] * 5]
    with pytest.raises(SetupError, match="tick at least one"):
        clone_of()


@pytest.mark.nightly  # trains two networks
def test_the_choice_of_drives_decides_how_good_the_clone_is() -> None:
    assert judge(find("11.2"), clone_of(drive_1=1, drive_3=1, drive_6=1)).passed
    assert not judge(find("11.2"), clone_of(drive_2=1)).passed


def test_the_dialogue_of_a_remote_brain_ends_with_the_silent_script(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(lesson_15, "MAX_DIALOGUE_S", LIMIT_S)
    answers = ["move;4;1;0;0;0", "move;4;0;0.3;0;0"]
    calls = itertools.count()

    def clock() -> float:
        """Tell a time that goes on with each look at it, however long the dialogue takes."""
        return 0.001 * next(calls)

    def brain(port: int) -> RemoteBrain:
        # real time: seconds of the clock above
        link = AI4ULink("127.0.0.1", port, receive_timeout=0.2, clock=clock)
        # real time: as above
        return RemoteBrain.with_link(link, clock=clock, receive_timeout=200)

    said = list(overheard(brain, answers))
    assert [line.removeprefix("script: ") for line in said[1::2][:2]] == answers
    states = [line for line in said if "bearing=" in line]
    assert [f"steps={number} " in line for number, line in enumerate(states)] == [True] * 3
    assert "did not answer for 0.2 s" in said[-1]


def test_a_filmed_check_says_how_its_first_episode_ended(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert film_check(find("12.2"), [[0, 0], [-5, 0]], [1, 0])
    assert "the robot reached its goal" in capsys.readouterr().out
