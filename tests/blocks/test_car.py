"""CarActuator: motion from throttle and steering, and driving with W A S D."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    Actuator,
    CarActuator,
    CBMoveActuator,
    CircleShape,
    Command,
    ControlRequestor,
    DifferentialDriveActuator,
    RBMoveActuator,
    WASDController,
    World,
)
from tests.builders import small_sim


def driven(action: Any, steps: int, heading: float = 0.0, **fields: Any) -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=heading)
    sim = small_sim(
        actuators=[CarActuator(**fields)], world=world, controller=lambda percept: {"move": action}
    )
    for _ in range(steps):
        sim.step()
    return sim


@pytest.mark.parametrize("heading", [0.0, 130.0])
@pytest.mark.parametrize(
    ("action", "forward", "turning"),
    [
        ((1, 0), 3, 0),
        ((-0.5, 0), -1.5, 0),
        ((0, 1), 0, 0),  # a car that stands does not turn
        ((1, 1), 3, -3 * math.tan(math.radians(30)) / 1.5),  # to the right
        ((1, -1), 3, 3 * math.tan(math.radians(30)) / 1.5),
        ((-1, 1), -3, 3 * math.tan(math.radians(30)) / 1.5),
        ((1, 0.0009), 3, 0),
    ],
)
def test_speeds(heading: float, action: Any, forward: float, turning: float) -> None:
    actuator = CarActuator(max_speed=3, max_steering_deg=30, wheelbase=1.5)
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=heading)
    body = small_sim(actuators=[actuator], world=world).agents[0].body
    actuator.act(body, action)
    vx, vy = body.velocity
    cos, sin = math.cos(body.heading), math.sin(body.heading)
    assert cos * vx + sin * vy == pytest.approx(forward)
    assert body.angular_velocity == pytest.approx(turning)
    # the middle of the rear axle never goes sideways
    assert cos * vy - sin * vx - body.angular_velocity * 1.5 / 2 == pytest.approx(0)


def test_the_rear_axle_goes_round_a_circle() -> None:
    fields: dict[str, Any] = {"max_speed": 2, "max_steering_deg": 35, "wheelbase": 1.6}
    radius = 1.6 / math.tan(math.radians(35))
    sim = driven([1, -1], 0, **fields)
    body = sim.agents[0].body
    for _ in range(400):
        sim.step()
        x, y = body.position
        rear = x - 0.8 * math.cos(body.heading), y - 0.8 * math.sin(body.heading)
        # it began at (-0.8, 0), looking along x: the middle of the circle is to its left
        assert math.dist(rear, (-0.8, radius)) == pytest.approx(radius, rel=0.02)
    assert abs(body.heading) != pytest.approx(0, abs=0.01)


def test_it_does_not_steer_in_the_air() -> None:
    sim = driven([1, 0], 1)
    actuator, body = sim.agents[0].actuators[0], sim.agents[0].body
    body.set_velocity(0, 0)
    body.jump(3)
    actuator.act(body, (1.0, 1.0))
    assert (body.velocity, body.angular_velocity) == ((0, 0), 0)


def answer(actuator: Actuator, *keys: str, **fields: Any) -> Any:
    sim = small_sim(controller=WASDController(**fields), actuators=[actuator])
    agent = sim.agents[0]
    agent.keyboard.hold(keys)
    decided = agent.brain.decide(agent.percept)
    if isinstance(decided, Command):
        return decided
    agent.accept(decided)  # whatever it is, the actuators take it
    return decided["move"]


@pytest.mark.parametrize(
    ("keys", "four", "two"),
    [
        ([], (0, 0, 0, 0), (0, 0)),
        (["KeyW"], (1, 0, 0, 0), (1, 1)),
        (["ArrowUp"], (1, 0, 0, 0), (1, 1)),
        (["KeyS"], (-1, 0, 0, 0), (-1, -1)),
        (["KeyA"], (0, -0.5, 0, 0), (-0.5, 0.5)),
        (["KeyD"], (0, 0.5, 0, 0), (0.5, -0.5)),
        (["ArrowRight"], (0, 0.5, 0, 0), (0.5, -0.5)),
        (["KeyW", "KeyD"], (1, 0.5, 0, 0), (1, 0.5)),
        (["KeyS", "KeyA"], (-1, -0.5, 0, 0), (-1, -0.5)),
        (["Space"], (0, 0, 1, 0), (0, 0)),
        (["KeyU"], (0, 0, 1, 0), (0, 0)),
        (["KeyJ"], (0, 0, 0, 1), (0, 0)),
    ],
)
def test_the_same_keys_drive_legs_and_wheels(keys: list[str], four: Any, two: Any) -> None:
    assert answer(RBMoveActuator(), *keys, turn_amount=0.5) == four
    assert answer(DifferentialDriveActuator(), *keys, turn_amount=0.5) == two


def test_keys_of_a_car_and_of_omni_wheels() -> None:
    assert answer(CarActuator(), "KeyW", "KeyA", components=["forward", "turn"]) == (1, -1)
    assert answer(CBMoveActuator(), "KeyW", "KeyD") == (1, 0, 1, 0, 0)
    assert answer(CBMoveActuator(), "KeyQ", "Space", left=["KeyQ"], jump=[]) == (0, -1, 0, 0, 0)


def test_r_restarts() -> None:
    assert answer(DifferentialDriveActuator(), "KeyR") is Command.RESTART
