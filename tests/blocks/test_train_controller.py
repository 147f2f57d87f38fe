"""TrainController: it executes a script's requests."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    DiscreteActuator,
    LocalBrain,
    Percept,
    RBMoveActuator,
    Scene,
    TrainController,
    Trainer,
    check_controller,
)
from ai4u_edu.base.errors import ActionError
from ai4u_edu.check import Outcome
from tests.builders import small_sim

AHEAD = (1.0, 0.0, 0.0, 0.0)


class Diary(Trainer):
    """Records its calls, and requests the actions of a list, one per decision."""

    def __init__(self, *actions: Any) -> None:
        self.told: list[Any] = []
        self._actions = list(actions)

    def on_setup(self) -> None:
        self.told.append(("setup", self.agent.id))

    def on_reset(self) -> None:
        self.told.append("reset")

    def state_updated(self, percept: Percept) -> None:
        self.told.append(percept)
        if self._actions:
            self.controller.request_continuous_action("move", self._actions.pop(0))


def test_a_request_is_done_once_and_without_one_nothing_is() -> None:
    controller = TrainController()
    sim = small_sim(controller=controller)
    agent = sim.agents[0]
    done = []
    for decision in range(4):
        if decision == 1:
            controller.request_continuous_action("move", [1, 0, 0, 0])
        sim.step()
        done.append(agent.last_action)
    assert done == [{}, {"move": AHEAD}, {}, {}]
    assert agent.body.position[0] > 0


def test_a_trainer_is_told_of_each_percept_and_requests_in_the_same_decision() -> None:
    trainer = Diary(AHEAD)
    controller = TrainController()
    controller.trainer = trainer
    sim = small_sim(controller=controller)
    agent = sim.agents[0]
    first = agent.percept
    sim.step()
    assert agent.last_action == {"move": AHEAD}
    assert trainer.controller is controller
    assert trainer.agent is agent
    assert trainer.told == [("setup", "0"), "reset", first]
    sim.step()
    assert agent.last_action == {}


def test_requests_to_two_actuators_are_taken_together_the_later_one_counts() -> None:
    controller = TrainController()
    actuators = [RBMoveActuator(), DiscreteActuator(action_name="gear")]
    sim = small_sim(controller=controller, actuators=actuators)
    controller.request_action("gear", [4])
    controller.request_continuous_action("move", (0, 1, 0, 0))
    controller.request_action("gear", [3])
    sim.step()
    assert sim.agents[0].last_action == {"gear": (3.0,), "move": (0.0, 1.0, 0.0, 0.0)}


def test_a_new_episode_on_request() -> None:
    controller = TrainController()
    sim = small_sim(controller=controller)
    agent = sim.agents[0]
    sim.tick()
    assert agent.episode == 1
    controller.request_continuous_action("move", AHEAD)
    controller.request_restart()
    sim.tick()
    sim.tick()
    assert agent.episode == 2
    assert agent.last_action == {}  # the reset forgot what was requested


@pytest.mark.parametrize(
    ("method", "values", "text"),
    [
        ("request_continuous_action", [1, math.nan], "expected finite numbers in a list, got"),
        ("request_continuous_action", "ahead", "expected finite numbers in a list, got 'ahead'"),
        ("request_continuous_action", 1.0, "expected finite numbers in a list, got 1.0"),
        ("request_action", [1.5], r"expected whole numbers in a list, got \[1.5\]"),
        ("request_action", [], r"expected whole numbers in a list, got \[\]"),
    ],
)
def test_what_is_no_action_is_refused_when_it_is_requested(
    method: str, values: Any, text: str
) -> None:
    controller = TrainController()
    small_sim(controller=controller)
    with pytest.raises(ActionError, match=f"action 'move': {text}"):
        getattr(controller, method)("move", values)


def test_an_unknown_actuator() -> None:
    controller = TrainController()
    small_sim(controller=controller)
    with pytest.raises(ActionError, match="no actuator is called 'mvoe'; did you mean 'move'"):
        controller.request_continuous_action("mvoe", AHEAD)


def test_a_scene_file_names_it_and_a_script_finds_it_there() -> None:
    text = """
name: x
bodies: [{name: robot}]
agents:
  - body: robot
    actuators: [{type: RBMoveActuator}]
    brains: [{type: LocalBrain, controller: {type: TrainController}}]
"""
    sim = Scene.loads(text).build()
    sim.reset(seed=0)
    brain = sim.agents[0].brain
    assert isinstance(brain, LocalBrain)
    assert isinstance(brain.controller, TrainController)
    brain.controller.request_continuous_action("move", AHEAD)
    sim.step()
    assert sim.agents[0].last_action == {"move": AHEAD}


def test_a_check_without_a_trainer_says_that_nothing_is_done() -> None:
    report = check_controller(TrainController(), decisions=10)
    assert report.ok
    assert [each.check for each in report.findings if each.outcome is Outcome.WARNING] == [
        "changes"
    ]
