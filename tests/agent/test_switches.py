"""Blocks that are switched on and off after the agent was set up."""

from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    FloatArrayCompositeSensor,
    HeadingSensor,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    RestlessnessRewardFunc,
    VelocitySensor,
    World,
)
from ai4u_edu.base.errors import SetupError
from tests.builders import still


def brain(turn: float, **parameters: Any) -> LocalBrain:
    return LocalBrain(
        controller=lambda percept: {"move": [0, turn, 0, 0]}, skip_frame=0, **parameters
    )


def sim_of(**parameters: Any) -> tuple[ControlRequestor, BasicAgent]:
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    agent = BasicAgent(body="robot", actuators=[RBMoveActuator()], **parameters)
    return ControlRequestor(world, [agent]), agent


def test_a_brain_that_is_enabled_drives_from_the_next_decision_on() -> None:
    first, second = brain(0.25), brain(0.5, enabled=False)
    sim, agent = sim_of(brains=[first, second])
    sim.reset()
    sim.step()
    assert agent.last_action["move"][1] == 0.25
    first.enabled, second.enabled = False, True
    sim.step()
    assert agent.last_action["move"][1] == 0.5
    assert agent.brain is second
    first.enabled, second.enabled = True, False
    sim.reset()
    sim.step()
    assert agent.last_action["move"][1] == 0.25
    assert agent.brain is first


def test_a_brain_that_is_enabled_during_a_decision_waits_for_its_end() -> None:
    first, second = brain(0.25), brain(0.5, enabled=False)
    first.skip_frame = 2
    sim, agent = sim_of(brains=[first, second])
    sim.reset()
    sim.tick()
    first.enabled, second.enabled = False, True
    sim.tick()
    sim.tick()
    assert (agent.steps, agent.brain is first) == (1, True)
    sim.tick()
    assert (agent.steps, agent.brain is second) == (2, True)


def test_a_brain_that_is_added_enabled_drives() -> None:
    first, second = brain(0.25), brain(0.5)
    sim, agent = sim_of(brains=[first])
    sim.reset()
    first.enabled = False
    agent.brains.append(second)
    sim.step()
    assert agent.last_action["move"][1] == 0.5


def test_no_brain_or_two_are_an_error_that_names_use_brain() -> None:
    first, second = brain(0.25), brain(0.5, enabled=False)
    sim, agent = sim_of(brains=[first, second])
    sim.reset()
    sim.step()
    second.enabled = True
    says = r"expected exactly one enabled brain, got 2: .*; or call agent.use_brain\(brain\)"
    with pytest.raises(SetupError, match=says):
        sim.step()
    first.enabled = second.enabled = False
    says = r"expected exactly one enabled brain, got none .*; or call agent.use_brain\(brain\)"
    with pytest.raises(SetupError, match=says):
        sim.step()
    agent.use_brain(second)
    sim.step()
    assert agent.last_action["move"][1] == 0.5


def test_a_brain_that_does_not_fit_leaves_the_present_one() -> None:
    class Unfit(LocalBrain):
        def on_setup(self, agent: Any, view: Any) -> None:
            raise SetupError("it does not fit")

    sim, agent = sim_of(brains=[brain(0.25)])
    sim.reset()
    unfit = Unfit(controller=lambda percept: {}, enabled=False)
    with pytest.raises(SetupError, match="it does not fit"):
        agent.use_brain(unfit)
    assert not unfit.enabled
    sim.step()
    assert agent.last_action["move"][1] == 0.25


@pytest.mark.parametrize(
    "blocks",
    [
        {"sensors": [VelocitySensor(is_active=False)]},
        {"actuators": [RBMoveActuator(action_name="other", is_active=False)]},
        {"rewards": [RestlessnessRewardFunc(is_active=False)]},
    ],
)
def test_a_block_that_was_off_at_setup_is_not_silently_left_out(blocks: dict[str, Any]) -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=still)], **blocks)
    sim = ControlRequestor(world, [agent])
    sim.reset()
    next(iter(blocks.values()))[0].is_active = True
    says = "was switched on, or added, after the agent was set up, and would have no effect"
    with pytest.raises(SetupError, match=says):
        sim.reset()
    agent.setup(world)
    sim.reset()
    sim.step()


def test_a_block_that_was_added_after_setup_is_not_silently_left_out() -> None:
    sim, agent = sim_of(brains=[brain(0.0)])
    sim.reset()
    agent.sensors.append(HeadingSensor())
    with pytest.raises(SetupError, match="HeadingSensor 'heading' was switched on, or added"):
        sim.reset()
    agent.setup(sim.world)
    sim.reset()
    assert "heading" in agent.percept


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("perception_key", "speed"),
        ("stacked_observations", 3),
        ("normalized", True),
        ("is_input", False),
        ("delay", 1),
        ("noise", 0.5),
        ("dropout", 0.5),
    ],
)
@pytest.mark.parametrize("is_inside", [False, True])
def test_what_counts_at_setup_is_refused_later(name: str, value: Any, is_inside: bool) -> None:
    sensor = VelocitySensor()
    outer = FloatArrayCompositeSensor(sensors=[sensor], range_min=-50, range_max=50)
    sim, agent = sim_of(brains=[brain(0.0)], sensors=[outer if is_inside else sensor])
    sim.reset()
    setattr(sensor, name, value)
    says = rf"VelocitySensor '\w+': {name} was set to {value!r} after the agent was set up"
    with pytest.raises(SetupError, match=says):
        sim.reset()
    agent.setup(sim.world)
    sim.reset()
    sim.step()


def test_another_name_of_an_actuator_is_refused_later() -> None:
    sim, agent = sim_of(brains=[brain(0.0)])
    sim.reset()
    agent.actuators[0].action_name = "go"
    with pytest.raises(SetupError, match=r"RBMoveActuator 'go': action_name was set to 'go' after"):
        sim.reset()


def test_noise_may_change_where_there_is_some() -> None:
    sensor = VelocitySensor(noise=0.5)
    sim, agent = sim_of(brains=[brain(0.0)], sensors=[sensor])
    sim.reset()
    sensor.noise = 1.5
    sim.reset()
    assert agent.percept["velocity"].any()


def test_another_port_of_a_script_is_refused_later() -> None:
    remote = RemoteBrain(port=9)
    sim, agent = sim_of(brains=[remote])
    sim.reset()
    remote.port = 10
    with pytest.raises(SetupError, match=r"port was set to 10 after the agent was set up"):
        sim.reset()
    agent.use_brain(remote)
    sim.reset()
    remote.close()
