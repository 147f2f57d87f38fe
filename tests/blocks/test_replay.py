"""ReplayController: recorded actions lead to the same positions."""

from typing import Any

import numpy as np
import pytest

from ai4u_edu import Command, DiscreteActuator, ReplayController
from ai4u_edu.base.errors import ParameterError
from tests.builders import small_sim, small_world


def test_the_same_actions_lead_to_the_same_places() -> None:
    rng = np.random.default_rng(3)
    sim = small_sim(controller=lambda percept: {"move": rng.uniform(-1, 1, 4)}, skip_frame=4)
    agent = sim.agents[0]
    actions, poses = [], []
    for _ in range(50):
        sim.step()
        actions.append({name: list(numbers) for name, numbers in agent.last_action.items()})
        poses.append(agent.body.pose)
    again = small_sim(controller=ReplayController(actions=actions), skip_frame=4)
    for pose in poses:
        again.step()
        assert again.agents[0].body.pose == pose


def told(ending: Any, count: int) -> list[Any]:
    replay = ReplayController(actions=[{"move": [n, 0, 0, 0]} for n in (1, 2, 3)], ending=ending)
    percept: Any = {}
    return [replay.get_action(percept) for _ in range(count)]


@pytest.mark.parametrize(
    ("ending", "numbers"), [("stop", [1, 2, 3]), ("repeat", [1, 2, 3, 1, 2, 3, 1])]
)
def test_the_ending(ending: str, numbers: list[float]) -> None:
    found = told(ending, 7)
    expected = [{"move": [n, 0, 0, 0]} for n in numbers]
    assert found == expected + [Command.STOP] * (7 - len(expected))


def test_after_the_stop_nothing_is_decided_until_a_reset_and_then_all_again() -> None:
    sim = small_sim(controller=ReplayController(actions=[{"move": [1.0, 0, 0, 0]}] * 3))
    agent = sim.agents[0]
    for _ in range(2):
        for _ in range(10):
            sim.step()
        assert agent.stopped
        assert agent.steps == 3
        sim.reset()


def test_choices_are_replayed_too() -> None:
    sim = small_sim(
        actuators=[DiscreteActuator()], controller=ReplayController(actions=[{"move": [3]}])
    )
    sim.step()
    assert sim.agents[0].last_action == {"move": (3.0,)}


def test_a_replay_of_nothing() -> None:
    with pytest.raises(ParameterError) as caught:
        ReplayController(actions=[])
    assert str(caught.value) == ("ReplayController: actions: expected at least 1 entries, got []")
    with pytest.raises(ParameterError, match="expected a finite number, got nan"):
        ReplayController(actions=[{"move": [float("nan")]}])


def test_a_robot_repeats_itself() -> None:
    actions: list[Any] = [{"move": [1, 0, 0, 0]}] * 5 + [{"move": [-1, 0, 0, 0]}] * 5
    controller = ReplayController(actions=actions, ending="repeat")
    sim = small_sim(controller=controller, world=small_world())
    xs = []
    for _ in range(30):
        sim.step()
        xs.append(sim.agents[0].body.position[0])
    assert xs[9] == pytest.approx(xs[29], abs=0.01)
    assert max(xs) > 0.1
