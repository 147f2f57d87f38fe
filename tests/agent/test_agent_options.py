"""Options of an agent that add blocks, rewards of handlers, and brains made of functions."""

from typing import Any

import pytest

from ai4u_edu import (
    ActionSensor,
    AgentArraySensor,
    BasicAgent,
    ContinuousActuator,
    ControlRequestor,
    LocalBrain,
    Scene,
    VelocitySensor,
    WASDRBMoveController,
)
from ai4u_edu.base.errors import AI4UError, BlockError, ParameterError, ReadingError, SetupError
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes.schema import scene_schema
from tests.builders import small_sim, small_world


def test_an_array_that_a_script_sets() -> None:
    sim = small_sim(array_input_size=2, range_min=-5, range_max=5)
    (agent,) = sim.agents
    assert agent.array_sensor is not None
    agent.array_sensor.set_values([-5, 2.5])
    sim.step()
    assert agent.percept["__initial_input__"].tolist() == [-5, 2.5]
    with pytest.raises(ReadingError, match="expected values from -5 to 5, got 6"):
        agent.array_sensor.set_value(0, 6)
    assert small_sim().agents[0].array_sensor is None


def test_a_sensor_of_ones_own_takes_the_place_of_the_optional_one() -> None:
    own = AgentArraySensor(size=3)
    (agent,) = small_sim([own], array_input_size=2).agents
    assert agent.array_sensor is own


def test_truncated_is_sensed() -> None:
    sim = small_sim(check_episode_truncated=True, max_steps_per_episode=1)
    seen = [sim.agents[0].percept["truncated"], sim.step()["truncated"]]
    assert seen == [False, True]
    assert "truncated" not in small_sim().agents[0].percept


def with_handler(handler: Any, answer: Any, **fields: Any) -> ControlRequestor:
    """An agent whose handler was set before it came into a world."""
    brain = LocalBrain(controller=lambda percept: {"defaultAction": answer}, skip_frame=0)
    agent = BasicAgent(body="robot", brains=[brain], **fields)
    agent.action_handler = handler
    sim = ControlRequestor(small_world(), [agent])
    sim.reset()
    return sim


@pytest.mark.parametrize(
    ("fields", "answer", "taken"),
    [
        ({"action_size": 2}, [0.5, -1], (0.5, -1.0)),
        ({"action_size": 9, "action_is_continuous": False}, 7, 7),
        ({}, 0.25, (0.25,)),
    ],
)
def test_a_handler_carries_out_the_default_action(
    fields: dict[str, Any], answer: Any, taken: Any
) -> None:
    done: list[Any] = []
    sim = with_handler(
        lambda body, given: done.append((body.name, given)),
        answer,
        sensors=[ActionSensor(action_name="defaultAction")],
        **fields,
    )
    sim.step()
    assert done == [("robot", taken)]
    sim.agents[0].action_handler = lambda body, given: done.append("other")
    sim.step()
    assert done[1:] == ["other"]


def test_without_a_handler_the_default_action_says_what_is_missing() -> None:
    sim = small_sim(action_size=1, controller=lambda percept: {"defaultAction": [1]})
    with pytest.raises(BlockError, match="'defaultAction': nobody takes its numbers; expected a f"):
        sim.step()
    with pytest.raises(BlockError, match="expected a row of the table for each of 3 choices"):
        small_sim(action_size=3, action_is_continuous=False)
    with pytest.raises(SetupError, match="action_handler: expected a function"):
        sim.agents[0].action_handler = 5  # type: ignore[assignment]  # the mistake under test


def test_a_handler_alone_makes_an_action_of_one_number() -> None:
    (made,) = with_handler(lambda body, numbers: None, 0.0).agents[0].actuators
    assert isinstance(made, ContinuousActuator)
    assert (made.action_name, made.size) == ("defaultAction", 1)


def test_scene_files_have_the_options() -> None:
    text = """
name: small
bodies: [{name: robot, shape: {type: circle}}]
agents:
  - body: robot
    array_input_size: 2
    range_max: 4
    action_size: 3
    check_episode_truncated: true
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
"""
    scene = Scene.loads(text)
    (agent,) = scene.build().agents
    assert list(agent.bound_blocks.actuators) == ["defaultAction"]
    assert set(agent.bound_blocks.layout.slots) == {"__initial_input__", "truncated", "done"}
    again = Scene(export_scene(scene.build()))  # as it is recorded
    assert list(again.build().agents[0].bound_blocks.actuators) == ["defaultAction"]
    fields = scene_schema()["$defs"]["BasicAgent"]["properties"]
    assert {"array_input_size", "action_size", "action_is_continuous"} <= set(fields)


@pytest.mark.parametrize("amount", [float("nan"), float("inf"), -float("inf"), "much", None, 1e308])
def test_a_handler_can_pay_finite_numbers_only(amount: Any) -> None:
    (agent,) = small_sim(id="red", reward_scale=10).agents
    with pytest.raises(ReadingError) as caught:
        agent.add_reward(amount, name="bonus")
    assert str(caught.value) == (
        f"agent 'red', add_reward of 'bonus': expected a finite number, got {amount!r}"
    )
    assert agent.reward == 0.0


def test_a_controller_or_a_function_may_drive() -> None:
    sim = small_sim()
    (agent,) = sim.agents
    for given in (WASDRBMoveController(), lambda percept: {"move": [1, 0, 0, 0]}):
        agent.use_brain(given)
        assert isinstance(agent.brain, LocalBrain)
        sim.step()
    assert agent.body.position[0] > 0
    other = BasicAgent(body="robot", brains=[lambda percept: {}])  # type: ignore[list-item]
    assert isinstance(other.brains[0], LocalBrain)


@pytest.mark.parametrize("given", [WASDRBMoveController, LocalBrain, 5, None, VelocitySensor()])
def test_what_cannot_drive_is_refused_in_a_sentence(given: Any) -> None:
    sim = small_sim()
    before = sim.agents[0].brain
    with pytest.raises(
        AI4UError, match="expected a brain, a controller or a function from percept"
    ):
        sim.agents[0].use_brain(given)
    assert sim.agents[0].brain is before
    with pytest.raises(ParameterError, match=r"brains\[0\]: expected a Brain, got "):
        BasicAgent(body="robot", brains=[given])
