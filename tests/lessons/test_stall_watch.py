"""Errors and endless loops of a student's code in a shown world: a sentence with the line."""

import math
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu.lessons import show, stop
from ai4u_edu.lessons.live import StallWatch
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.runtime.runner import Runner
from tests.lessons.workbook import run
from tests.waiting import LIMIT_S, until

WAITS = "stuck = True\ndef go(percept):\n    while stuck:\n        pass\n    return {}"
LOOP = "def go(percept):\n    while True:\n        pass"


@pytest.fixture(autouse=True)
def watches(monkeypatch: pytest.MonkeyPatch, limit_s: float) -> Iterator[list[StallWatch]]:
    """Watches of the worlds that are shown; the last world is ended."""
    made: list[StallWatch] = []

    def watch(runner: Runner) -> StallWatch:
        made.append(StallWatch(runner, limit_s, 0.05))
        return made[-1]

    monkeypatch.setattr("ai4u_edu.runtime.tick_monitor.STALL_S", 0.1)
    monkeypatch.setattr("ai4u_edu.lessons.live.StallWatch", watch)
    yield made
    stop()


@pytest.fixture
def limit_s() -> float:
    """Time (s) after which a call counts as endless."""
    return math.inf


def typed(source: str) -> Any:
    """A function as typed into a cell."""
    names: dict[str, Any] = {}
    run(Cell(source), names, f"/tmp/ipykernel_1/{abs(hash(source))}.py")  # noqa: S108 - no file
    return names["go"]


def test_an_error_is_shown_with_its_line() -> None:
    world = show("box_chase", typed("def go(percept):\n    return {'move': [1 / 0, 0, 0, 0]}"))
    until(lambda: bool(world.runner.latest.error))
    assert world.runner.latest.error == (
        "Your code stopped with ZeroDivisionError: division by zero (line 2 of its cell: "
        "return {'move': [1 / 0, 0, 0, 0]})."
    )


def test_an_action_that_no_actuator_takes_is_told_as_before() -> None:
    world = show("box_chase", lambda percept: {"mov": [0, 0, 0, 0]})
    until(lambda: bool(world.runner.latest.error))
    assert "did you mean 'move'?" in world.runner.latest.error


@pytest.mark.parametrize("limit_s", [0.3])
def test_an_endless_loop_ends_with_its_line_and_the_world_can_be_reset(
    watches: list[StallWatch],
) -> None:
    go = typed(WAITS)
    world = show("box_chase", go)
    wanted = (
        "Your code did not answer for 0.3 s (line 3 of its cell: while stuck:). The robot asks it "
        'again at each decision: use "if", not "while".'
    )
    until(lambda: world.runner.latest.error == wanted)
    until(lambda: world.runner.stall is None)
    watches[0].stop()  # a call that a busy machine keeps for so long is none of these
    go.__globals__["stuck"] = False
    world.runner.reset(1).result(LIMIT_S)
    until(lambda: world.runner.latest.tick > 10)
    assert world.runner.latest.error == ""


def test_a_loop_does_not_outlive_its_world() -> None:
    world = show("box_chase", typed(LOOP))
    until(lambda: "(a notebook's cell, line 2)" in str(world.runner.stall))
    stop()
    until(lambda: not world.runner.is_left_behind)
