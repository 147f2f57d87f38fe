"""Keyboard controllers with arrow keys: from keys to actions."""

from typing import Any

import pytest

from ai4u_edu import (
    Actuator,
    ArrowController,
    CBMoveActuator,
    Command,
    ContinuousActuator,
    Controller,
    DifferentialDriveActuator,
    DiscreteActuator,
    DiscreteArrowController,
    GrabActuator,
    RBMoveActuator,
)
from ai4u_edu.base.errors import BlockError, ParameterError
from tests.builders import small_sim


def answer(controller: Controller, actuators: list[Actuator], *keys: str) -> Any:
    sim = small_sim(controller=controller, actuators=actuators)
    agent = sim.agents[0]
    agent.keyboard.hold(keys)
    decided = agent.brain.decide(agent.percept)
    if not isinstance(decided, Command):
        agent.accept(decided)  # whatever it is, the actuators take it
    return decided


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ([], (0, 0, 0, 0, 0)),
        (["ArrowUp"], (0.5, 0, 0, 0, 0)),
        (["ArrowDown"], (-0.5, 0, 0, 0, 0)),
        (["ArrowLeft"], (0, 0, -1, 0, 0)),
        (["ArrowRight"], (0, 0, 1, 0, 0)),
        (["Space"], (0, 0, 0, 1, 0)),
        (["Enter"], (0, 0, 0, 0, 1)),
        (["ArrowUp", "ArrowRight", "Space"], (0.5, 0, 1, 1, 0)),
        (["ArrowUp", "ArrowDown"], (0, 0, 0, 0, 0)),
        (["KeyW", "F5"], (0, 0, 0, 0, 0)),
    ],
)
def test_five_numbers_for_omni_wheels(keys: list[str], expected: tuple[float, ...]) -> None:
    assert answer(ArrowController(), [CBMoveActuator()], *keys) == {"move": expected}


def test_keys_can_be_remapped_and_amounts_set() -> None:
    controller = ArrowController(
        left=["ArrowLeft"],
        right=["ArrowRight"],
        turn_left=["KeyA"],
        turn_right=["KeyD"],
        speed=0.25,
        turn_amount=0.75,
        jump_power=0.5,
    )
    keys = ("ArrowLeft", "KeyD", "Space", "Enter")
    assert answer(controller, [CBMoveActuator()], *keys) == {"move": (0, -0.25, 0.75, 0.5, 0.5)}


@pytest.mark.parametrize(
    ("actuator", "expected"),
    [
        (RBMoveActuator(), (0.5, 1, 0, 0)),
        (CBMoveActuator(), (0.5, 0, 1, 0, 0)),
        (DifferentialDriveActuator(), (1, -0.5)),
        (ContinuousActuator(size=7, action_name="move"), (0.5, 0, 1, 0, 0, 0, 0)),
        (ContinuousActuator(size=1, action_name="move"), (0,)),
    ],
)
def test_the_layout_follows_the_actuator(actuator: Actuator, expected: tuple[float, ...]) -> None:
    assert answer(ArrowController(), [actuator], "ArrowUp", "ArrowRight") == {"move": expected}


def test_the_layout_can_be_given() -> None:
    controller = ArrowController(components=["none", "turn", "forward"], actuator_name="go")
    actuators: list[Actuator] = [ContinuousActuator(size=3, action_name="go")]
    assert answer(controller, actuators, "ArrowUp", "ArrowLeft") == {"go": (0, -1, 0.5)}


def test_extra_actions() -> None:
    controller = ArrowController(
        extra_keys=[["KeyX"], ["KeyY", "KeyZ"]],
        extra_actions_index=[5, 0],
        extra_actions_value=[0.5, -1],
    )
    actuators: list[Actuator] = [ContinuousActuator(size=6, action_name="move")]
    assert answer(controller, actuators, "ArrowUp") == {"move": (0.5, 0, 0, 0, 0, 0)}
    assert answer(controller, actuators, "ArrowUp", "KeyY") == {"move": (-1, 0, 0, 0, 0, 0)}
    assert answer(controller, actuators, "KeyX", "KeyZ") == {"move": (-1, 0, 0, 0, 0, 0.5)}


def test_switches_for_other_actuators() -> None:
    controller = ArrowController(switches={"grab": ["KeyG"]})
    actuators: list[Actuator] = [DifferentialDriveActuator(), GrabActuator()]
    assert answer(controller, actuators) == {"move": (0, 0), "grab": 0.0}
    assert answer(controller, actuators, "KeyG") == {"move": (0, 0), "grab": 1.0}


def setup_error(controller: Controller, actuator: Actuator | None = None) -> str:
    with pytest.raises(BlockError) as caught:
        small_sim(controller=controller, actuators=[actuator or RBMoveActuator()])
    brain = f"LocalBrain({type(controller).__name__})"
    return str(caught.value).removeprefix(f"agent '0', {brain}: ")


def test_what_does_not_fit_is_said_at_setup() -> None:
    assert setup_error(ArrowController(actuator_name="mov")) == (
        "no actuator is called 'mov'; did you mean 'move'?"
    )
    assert setup_error(ArrowController(switches={"hand": []})) == (
        "no actuator is called 'hand'; known are 'move'"
    )
    assert setup_error(ArrowController(components=["turn"])) == (
        "components: expected 4, as actuator 'move' takes, got 1"
    )
    assert setup_error(ArrowController(extra_keys=[["KeyX"]])) == (
        "expected as many extra_keys as extra_actions_index and extra_actions_value, got 1, 0 and 0"
    )
    assert setup_error(
        ArrowController(extra_keys=[["KeyX"]], extra_actions_index=[4], extra_actions_value=[1])
    ) == (
        "extra_actions_index: expected indices up to 3, as actuator 'move' takes 4 numbers, got 4"
    )
    assert setup_error(DiscreteArrowController(actuator_name="mvoe")) == (
        "no actuator is called 'mvoe'; did you mean 'move'?"
    )
    wrong: Any = ["sideways"]
    with pytest.raises(ParameterError, match=r"components\[0\]: expected 'forward', 'strafe'"):
        ArrowController(components=wrong)


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ([], 0),
        (["ArrowRight"], 1),
        (["ArrowLeft"], 2),
        (["ArrowUp"], 3),
        (["ArrowDown"], 4),
        (["Enter"], 5),
        (["Space"], 5),
        (["KeyQ"], 0),
    ],
)
def test_one_choice_a_key(keys: list[str], expected: int) -> None:
    actuator = DiscreteActuator(size=6, table=[(0, 0, 0, 0)] * 6)
    assert answer(DiscreteArrowController(), [actuator], *keys) == {"move": expected}


def test_choices_can_be_remapped() -> None:
    controller = DiscreteArrowController(up=["KeyI"], accept=[])
    assert answer(controller, [DiscreteActuator()], "KeyI") == {"move": 3}
    assert answer(controller, [DiscreteActuator()], "ArrowUp") == {"move": 0}


@pytest.mark.parametrize(("size", "down"), [(5, 4), (4, 0)])
def test_a_choice_that_the_actuator_lacks_does_nothing(size: int, down: int) -> None:
    actuator = DiscreteActuator(size=size)
    assert answer(DiscreteArrowController(), [actuator], "Space") == {"move": 0}
    assert answer(DiscreteArrowController(), [actuator], "ArrowDown") == {"move": down}
    assert answer(DiscreteArrowController(), [actuator], "Space", "ArrowUp") == {"move": 3}


def test_the_key_pressed_last_counts_and_then_the_one_before_again() -> None:
    sim = small_sim(controller=DiscreteArrowController(), actuators=[DiscreteActuator()])
    agent = sim.agents[0]
    for held, expected in (
        (["ArrowUp"], 3),
        (["ArrowUp", "ArrowRight"], 1),
        (["ArrowUp", "ArrowRight", "ArrowLeft"], 2),
        (["ArrowUp", "ArrowRight"], 1),
        (["ArrowUp"], 3),
        ([], 0),
        (["ArrowUp", "ArrowRight"], 3),  # both at once: as they are listed, the later one counts
    ):
        agent.keyboard.hold(held)
        assert agent.brain.decide(agent.percept) == {"move": expected}


@pytest.mark.parametrize("controller", [ArrowController(), DiscreteArrowController()])
def test_r_restarts_once_a_press(controller: Controller) -> None:
    actuator: Actuator = RBMoveActuator()
    if isinstance(controller, DiscreteArrowController):
        actuator = DiscreteActuator()
    sim = small_sim(controller=controller, actuators=[actuator])
    agent = sim.agents[0]
    for held, episodes in ((["KeyR"], 2), (["KeyR", "ArrowUp"], 2), ([], 2), (["KeyR"], 3)):
        agent.keyboard.hold(held)
        sim.tick()
        sim.tick()
        assert sim.episode == episodes


def test_arrows_drive_a_body() -> None:
    sim = small_sim(
        controller=DiscreteArrowController(), actuators=[DiscreteActuator(move_amount=2)]
    )
    agent = sim.agents[0]
    for _ in range(60):
        agent.keyboard.hold(["ArrowUp"])
        sim.step()
    assert agent.body.position[0] == pytest.approx(2, rel=0.06)
