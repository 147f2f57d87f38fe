"""ForceMoveActuator, ProgressReward, and rays that read only distances."""

import math
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    ForceMoveActuator,
    LinearRayCastingSensor,
    LocalBrain,
    ProgressReward,
    World,
)
from ai4u_edu.base.errors import BlockError, NameNotFoundError


def pushed(action: list[float], mass: float = 2.0) -> ControlRequestor:
    world = World(damping=0.05)
    world.add_body("robot", CircleShape(radius=0.3), heading_deg=90, mass=mass)
    agent = BasicAgent(
        body="robot",
        actuators=[ForceMoveActuator(force=12, turn_amount=2)],
        brains=[LocalBrain(controller=lambda percept: {"move": action}, skip_frame=0)],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset()
    return sim


def test_a_push_speeds_up_along_the_heading() -> None:
    sim = pushed([1, 0])
    body = sim.agents[0].body
    sim.step()
    assert body.velocity == pytest.approx((0, 12 / 2 / 60), rel=1e-6)
    sim.step()
    assert body.velocity[1] > 1.9 * 12 / 2 / 60


def test_it_ends_up_at_the_speed_that_the_docstring_tells() -> None:
    sim = pushed([-1, 0])
    for _ in range(600):
        sim.step()
    assert sim.agents[0].body.velocity[1] == pytest.approx(12 / (2 * math.log(0.05)), rel=0.03)


def test_above_zero_turns_to_the_right() -> None:
    sim = pushed([0, 0.5])
    sim.step()
    body = sim.agents[0].body
    assert body.heading == pytest.approx(math.pi / 2 - 1 / 60)


def test_in_the_air_it_does_nothing() -> None:
    sim = pushed([1, 1])
    body = sim.agents[0].body
    body.jump(5)
    sim.step()
    assert (body.velocity, body.angular_velocity) == ((0, 0), 0)


def progress(target: str = "goal") -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    world.add_body("goal", CircleShape(radius=0.3), position=(3, 4), kind="static")
    agent = BasicAgent(
        body="robot",
        rewards=[ProgressReward(target=target, reward=10)],
        brains=[LocalBrain(controller=lambda percept: {})],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset()
    return sim


def test_each_metre_is_paid_and_each_metre_back_costs() -> None:
    sim = progress()
    agent, paid = sim.agents[0], []
    robot = sim.world["robot"]
    for x, y in ((0, 0), (0, 4), (0, 0), (3, 3)):
        robot.move_to(x, y)
        sim.step()
        paid.append(agent.reward)
    assert paid == pytest.approx([0, 20, -20, 40])
    sim.reset()
    sim.step()
    assert agent.reward == 0, "the first decision of an episode is free"


def test_progress_towards_nothing() -> None:
    with pytest.raises(BlockError, match="no body is named 'gaol'; did you mean 'goal'") as caught:
        progress("gaol")
    assert isinstance(caught.value.__cause__, NameNotFoundError)


def test_rays_tell_distances_alone() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    world.add_body("ball", CircleShape(radius=0.5), position=(0, 2.5), tags=("ball",))
    rays: dict[str, Any] = {"number_of_rays": 3, "field_of_view": 360, "vision_max_distance": 8}
    alone = LinearRayCastingSensor(
        perception_key="a", return_code=False, return_distance=True, **rays
    )
    both = LinearRayCastingSensor(
        perception_key="b", return_distance=True, group_code={"ball": 3}, **rays
    )
    metres = LinearRayCastingSensor(
        perception_key="c",
        return_code=False,
        return_distance=True,
        normalize_distance=False,
        **rays,
    )
    agent = BasicAgent(
        body="robot",
        sensors=[alone, both, metres],
        brains=[LocalBrain(controller=lambda percept: {})],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset()
    percept = agent.percept
    assert percept["a"].tolist() == [0, 0, 0.25]
    assert percept["b"].tolist() == [0, 0, 0, 0, 1, 0.25]
    assert percept["c"].tolist() == [0, 0, 2]
    assert alone.space().shape == (3,)
    assert np.allclose(alone.picture().ends[2], (0, 2, 0.5), atol=1e-9)
    assert both.picture().groups == ("", "", "ball")


def test_rays_that_tell_nothing() -> None:
    with pytest.raises(BlockError) as caught:
        LinearRayCastingSensor(return_code=False)
    assert str(caught.value) == (
        "LinearRayCastingSensor 'linear_ray_casting': expected return_code or return_distance, "
        "got neither"
    )
