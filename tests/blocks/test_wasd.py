"""Keyboard controllers with W, A, S, D: from keys to actions."""

from typing import Any

import pytest

from ai4u_edu import Command, Keyboard, WASDRBMoveController
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.blocks.keyboard import KEY_TIMEOUT_S
from tests.builders import small_sim


def action(*keys: str, **fields: Any) -> Any:
    sim = small_sim(controller=WASDRBMoveController(**fields))
    sim.agents[0].keyboard.hold(keys)
    answer = sim.agents[0].brain.decide(sim.agents[0].percept)
    return answer if isinstance(answer, Command) else answer["move"]


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ([], (0, 0, 0, 0)),
        (["KeyW"], (1, 0, 0, 0)),
        (["ArrowUp"], (1, 0, 0, 0)),
        (["KeyS"], (-1, 0, 0, 0)),
        (["KeyA"], (0, -1, 0, 0)),
        (["KeyD"], (0, 1, 0, 0)),
        (["ArrowLeft"], (0, -1, 0, 0)),
        (["ArrowRight"], (0, 1, 0, 0)),
        (["KeyW", "KeyD"], (1, 1, 0, 0)),
        (["KeyW", "KeyS"], (0, 0, 0, 0)),
        (["KeyW", "ArrowUp"], (1, 0, 0, 0)),
        (["Space"], (0, 0, 1, 0)),
        (["KeyU"], (0, 0, 1, 0)),
        (["KeyJ"], (0, 0, 0, 1)),
        (["KeyQ", "F5"], (0, 0, 0, 0)),
    ],
)
def test_keys(keys: list[str], expected: tuple[float, ...]) -> None:
    assert action(*keys) == expected


def test_r_restarts_once_a_press() -> None:
    sim = small_sim(controller=WASDRBMoveController())
    agent = sim.agents[0]
    for held, episodes in ((["KeyR"], 2), (["KeyR"], 2), ([], 2), (["KeyR"], 3)):
        agent.keyboard.hold(held)
        sim.tick()
        sim.tick()
        assert sim.episode == episodes


def test_keys_can_be_remapped_and_amounts_set() -> None:
    assert action("KeyZ", forward=["KeyZ"], speed=0.5) == (0.5, 0, 0, 0)
    assert action("KeyW", forward=["KeyZ"]) == (0, 0, 0, 0)
    with pytest.raises(ParameterError, match="speed: expected at most 1, got 2"):
        WASDRBMoveController(speed=2)


class Clock:
    """A clock that is set by hand."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_silence_lets_the_keys_go() -> None:
    clock = Clock()
    keyboard = Keyboard(clock)
    keyboard.timeout_s = KEY_TIMEOUT_S
    keyboard.hold(["KeyW"])
    clock.now = 0.29
    assert keyboard.read() == {"KeyW"}
    clock.now = 0.31
    assert keyboard.read() == set()
    keyboard.hold(["KeyW"])
    assert keyboard.held() == {"KeyW"}


def test_a_tap_between_two_reads_is_not_missed_and_counts_once() -> None:
    keyboard = Keyboard(Clock())
    keyboard.hold(["Space"])
    keyboard.hold([])
    assert keyboard.held() == set()
    assert keyboard.read() == {"Space"}
    assert keyboard.read() == set()


def test_release_forgets_taps_too() -> None:
    keyboard = Keyboard(Clock())
    keyboard.hold(["KeyW", "Space"])
    keyboard.release()
    assert keyboard.read() == set()


def test_a_released_key_stops_the_body_at_the_next_decision() -> None:
    sim = small_sim(controller=WASDRBMoveController())
    agent = sim.agents[0]
    agent.keyboard.hold(["KeyW"])
    sim.step()
    assert agent.body.velocity[0] == pytest.approx(2.0, rel=0.1)
    agent.keyboard.hold([])
    sim.step()
    assert agent.body.velocity[0] == 0.0
