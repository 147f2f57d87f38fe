"""RBMoveActuator: motion from its numbers and parameters."""

import math
from typing import Any

import pytest

from ai4u_edu import ControlRequestor, RBMoveActuator, World
from ai4u_edu.world import CircleShape
from tests.builders import small_sim


def driven(
    action: list[float], ticks: int, heading: float = 0.0, **fields: Any
) -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=heading)
    sim = small_sim(
        actuators=[RBMoveActuator(**fields)],
        world=world,
        controller=lambda percept: {"move": action},
    )
    for _ in range(ticks):
        sim.step()
    return sim


def answer(sim: ControlRequestor, action: list[float]) -> None:
    brain: Any = sim.agents[0].brain
    brain.controller.function = lambda percept: {"move": action}


@pytest.mark.parametrize("forward", [1.0, 0.5, -1.0])
@pytest.mark.parametrize("heading", [0.0, 90.0, 200.0])
def test_forward_is_a_speed_along_the_heading(forward: float, heading: float) -> None:
    x, y = driven([forward, 0, 0, 0], 61, heading, move_amount=3).agents[0].body.position
    # a speed set before a tick moves the body from the tick after it on
    along = x * math.cos(math.radians(heading)) + y * math.sin(math.radians(heading))
    assert along == pytest.approx(3 * forward, rel=0.06)
    assert math.hypot(x, y) == pytest.approx(abs(along))


@pytest.mark.parametrize("turn", [1.0, -0.5])
def test_positive_turn_is_clockwise(turn: float) -> None:
    body = driven([0, turn, 0, 0], 61, turn_amount=2).agents[0].body
    assert body.heading == pytest.approx(-2 * turn, rel=0.06)
    assert body.position == (0, 0)


def test_jump_rises_v_squared_over_2g() -> None:
    sim = driven([0, 0, 1, 0], 1, jump_power=4)
    body = sim.agents[0].body
    highest, ticks = body.z, 1
    while not body.on_ground:
        sim.world.tick()
        highest, ticks = max(highest, body.z), ticks + 1
    assert highest == pytest.approx(16 / (2 * 9.81), rel=0.01)
    assert ticks / 60 == pytest.approx(2 * 4 / 9.81, abs=1 / 60)


def test_forward_jump_is_both() -> None:
    body = driven([0, 0, 0, 1], 2, jump_power=3, jump_forward_power=2).agents[0].body
    assert body.velocity[0] == pytest.approx(2.0)
    assert body.vz > 2.0


def test_nothing_steers_in_the_air() -> None:
    sim = driven([1, 0, 1, 0], 1, move_amount=2, jump_power=4)
    agent = sim.agents[0]
    vx = agent.body.velocity[0]
    answer(sim, [-1, 1, 0, 0])
    for _ in range(20):
        sim.step()
        assert not agent.body.on_ground
        assert agent.body.velocity == pytest.approx((vx, 0))
        assert agent.body.angular_velocity == 0


def test_tiny_numbers_count_as_zero() -> None:
    body = driven([0.0009, 0.0009, 0.0009, 0.0009], 10).agents[0].body
    assert (body.position, body.heading, body.z) == ((0, 0), 0, 0)


def test_zeros_stop() -> None:
    sim = driven([1, 1, 0, 0], 10)
    answer(sim, [0, 0, 0, 0])
    sim.step()
    body = sim.agents[0].body
    assert body.velocity == pytest.approx((0, 0), abs=1e-12)
    assert body.angular_velocity == 0
