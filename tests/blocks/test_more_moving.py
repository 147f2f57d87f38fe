"""Actuators for omni wheels, two wheels, tables of motions and scripts."""

import math
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Discrete

from ai4u_edu import (
    Actuator,
    Body,
    CBMoveActuator,
    CircleShape,
    ContinuousActuator,
    ControlRequestor,
    DifferentialDriveActuator,
    DiscreteActuator,
    RBMoveActuator,
    World,
)
from ai4u_edu.base.errors import ActionError, BlockError, ParameterError
from tests.builders import small_sim


def sim_with(actuator: Actuator, heading: float = 0.0, action: Any = None) -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), heading_deg=heading)
    name = actuator.action_name
    return small_sim(
        actuators=[actuator],
        world=world,
        controller=lambda percept: {} if action is None else {name: action},
    )


def set_by(actuator: Actuator, action: tuple[float, ...], heading: float = 0.0) -> list[float]:
    """Return the [forward, left, turning, upward] speed after an action, before any tick."""
    body = sim_with(actuator, heading).agents[0].body
    actuator.act(body, action)
    vx, vy = body.velocity
    cos, sin = math.cos(body.heading), math.sin(body.heading)
    return [cos * vx + sin * vy, cos * vy - sin * vx, body.angular_velocity, body.vz]


OMNI: dict[str, Any] = {
    "move_amount": 3, "turn_amount": 2, "jump_power": 4, "jump_forward_power": 1.5
}  # fmt: skip


@pytest.mark.parametrize("heading", [0.0, 37.0, 180.0])
@pytest.mark.parametrize(
    ("action", "expected"),
    [
        ((1, 0, 0, 0, 0), [3, 0, 0, 0]),
        ((-0.5, 0, 0, 0, 0), [-1.5, 0, 0, 0]),
        ((0, 1, 0, 0, 0), [0, -3, 0, 0]),  # strafing right
        ((0, 0, 1, 0, 0), [0, 0, -2, 0]),  # turning right
        ((0, 0, 0, 0.5, 0), [0, 0, 0, 2]),
        ((0, 0, 0, 0, 1), [1.5, 0, 0, 4]),
        ((1, -1, -0.5, 1, 0.5), [3.75, 3, 1, 6]),
        ((0.0009, 0.0009, 0.0009, 0.0009, 0.0009), [0, 0, 0, 0]),
    ],
)
def test_omni_wheels(heading: float, action: Any, expected: list[float]) -> None:
    found = set_by(CBMoveActuator(**OMNI), action, heading)
    assert found == pytest.approx(expected, abs=1e-12)


def test_omni_wheels_go_sideways() -> None:
    sim = sim_with(CBMoveActuator(move_amount=3), 90, [0, 1, 0, 0, 0])
    for _ in range(61):
        sim.step()
    x, y = sim.agents[0].body.position  # it looks along +y; its right is +x
    assert x == pytest.approx(3, rel=0.06)
    assert y == pytest.approx(0, abs=1e-9)


def test_the_dead_zone_is_a_parameter() -> None:
    actuator = CBMoveActuator(dead_zone=0.2)
    assert set_by(actuator, (0.19, 0.21, 0, 0, 0)) == pytest.approx([0, -0.21, 0, 0])


def test_nothing_steers_in_the_air() -> None:
    for actuator, action in (
        (CBMoveActuator(), (1.0, 1, 1, 0, 0)),
        (DifferentialDriveActuator(), (1.0, 0)),
        (DiscreteActuator(), (3.0,)),
        (RBMoveActuator(), (1.0, 1, 0, 0)),
    ):
        body = sim_with(actuator).agents[0].body
        body.jump(3)
        actuator.act(body, action)
        assert (body.velocity, body.angular_velocity) == ((0, 0), 0)


def noisy_speeds(seed: int, count: int = 4000, **noise: Any) -> Any:
    actuator = CBMoveActuator(**OMNI, **noise)
    sim = sim_with(actuator)
    sim.reset(seed)
    body = sim.agents[0].body
    found = []
    for _ in range(count):
        actuator.act(body, (0.5, 0, -0.5, 0, 0))
        found.append((*body.velocity, body.angular_velocity))
    return np.array(found)


def test_noise_has_the_deviation_it_says() -> None:
    forward, left, turning = noisy_speeds(1, move_noise=0.1, turn_noise=0.2).T
    assert np.mean(forward) == pytest.approx(1.5, abs=0.02)
    assert np.std(forward) == pytest.approx(3 * 0.1, rel=0.05)
    assert not left.any()  # what is 0 stays 0
    assert np.mean(turning) == pytest.approx(1.0, abs=0.03)
    assert np.std(turning) == pytest.approx(2 * 0.2, rel=0.05)


def test_noise_comes_from_the_worlds_seed() -> None:
    one, same, other = (noisy_speeds(seed, 5, move_noise=0.1) for seed in (1, 1, 2))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


@pytest.mark.parametrize("leap", [0.0, 0.1])
def test_noise_never_makes_a_jump_point_down_or_back_nor_a_body_at_rest_move(leap: float) -> None:
    actuator = CBMoveActuator(jump_power=1, jump_noise=5, move_noise=1, turn_noise=1)
    sim = sim_with(actuator)
    body, speeds = sim.agents[0].body, []
    for seed in range(60):
        sim.reset(seed)
        actuator.act(body, (0, 0, 0, 0.1 - leap, leap))
        speeds.append(body.vz)
        forward, left = body.velocity
        assert forward >= 0
        assert (forward > 0) is (body.vz > 0 and leap > 0)
        assert (left, body.angular_velocity) == (0, 0)
    assert min(speeds) == 0.0
    assert sum(speed > 0 for speed in speeds) > 20


@pytest.mark.parametrize("heading", [0.0, 130.0])
@pytest.mark.parametrize(
    ("wheels", "expected"),
    [
        ((1, 1), [2, 0, 0, 0]),
        ((-0.5, -0.5), [-1, 0, 0, 0]),
        ((-1, 1), [0, 0, 2 * 2 / 0.4, 0]),  # on the spot, counter-clockwise
        ((1, 0), [1, 0, -2 / 0.4, 0]),  # around the right wheel
        ((0.0009, 0.5), [0.5, 0, 1 / 0.4, 0]),
    ],
)
def test_two_wheels(heading: float, wheels: Any, expected: list[float]) -> None:
    actuator = DifferentialDriveActuator(max_wheel_speed=2, axle_width=0.4)
    assert set_by(actuator, wheels, heading) == pytest.approx(expected, abs=1e-12)


def test_two_wheels_drive_the_circle_that_they_should() -> None:
    # radius = axle / 2 * (right + left) / (right - left) = 0.75 m, to the left
    actuator = DifferentialDriveActuator(max_wheel_speed=1, axle_width=0.5)
    sim = sim_with(actuator, 0, [0.5, 1.0])
    places = []
    for _ in range(400):  # a round takes 2 pi s
        sim.step()
        places.append(sim.agents[0].body.position)
    xs, ys = zip(*places, strict=True)
    assert max(xs) - min(xs) == pytest.approx(1.5, rel=0.02)
    assert max(ys) - min(ys) == pytest.approx(1.5, rel=0.02)
    assert min(ys) == pytest.approx(0, abs=0.02)


@pytest.mark.parametrize("index", range(5))
def test_the_table_of_arrows_moves_as_rb_move_does(index: int) -> None:
    row = [(0, 0, 0, 0), (0, 1, 0, 0), (0, -1, 0, 0), (1, 0, 0, 0), (-1, 0, 0, 0)][index]
    powers: dict[str, Any] = {"move_amount": 3, "turn_amount": 2}
    expected = set_by(RBMoveActuator(**powers), row, 40)
    assert set_by(DiscreteActuator(**powers), (float(index),), 40) == expected
    assert any(expected) == (index > 0)


def test_a_table_of_ones_own() -> None:
    table: Any = [(0, 0, 1, 0), (0.5, 0.25, 0, 0.5)]
    actuator = DiscreteActuator(table=table, **OMNI)
    assert set_by(actuator, (0.0,)) == pytest.approx([0, 0, 0, 4])
    assert set_by(actuator, (1.0,)) == pytest.approx([1.5 + 0.75, 0, -0.5, 2])
    assert actuator.space() == Discrete(2)


def test_the_space_is_as_large_as_the_table_unless_it_is_given() -> None:
    assert DiscreteActuator().space() == Discrete(5)
    assert DiscreteActuator(size=3).space() == Discrete(3)
    assert not DiscreteActuator.is_continuous


@pytest.mark.parametrize("value", [3, 3.0, [3], (3,), np.int64(3), np.array([3]), np.array(3)])
def test_a_choice_may_come_as_an_int(value: Any) -> None:
    sim = sim_with(DiscreteActuator(move_amount=2), 0, value)
    sim.step()
    assert sim.agents[0].last_action == {"move": (3.0,)}
    assert sim.agents[0].body.velocity[0] == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("value", [5, -1, 1.5, [1, 2], [], "up", None, math.nan])
def test_what_is_no_choice(value: Any) -> None:
    sim = sim_with(DiscreteActuator())
    with pytest.raises(ActionError) as caught:
        sim.agents[0].accept({"move": value})
    assert str(caught.value) == (
        f"action 'move': expected a whole number from 0 to 4, got {value!r}"
    )


def test_a_row_is_missing() -> None:
    with pytest.raises(BlockError) as caught:
        sim_with(DiscreteActuator(size=7))
    assert str(caught.value) == (
        "agent '0', DiscreteActuator 'move': expected a row of the table for each of 7 choices, "
        "got 5 rows; add some, or set a handler"
    )


def test_a_row_out_of_range() -> None:
    with pytest.raises(ParameterError, match="expected at most 1, got 2"):
        DiscreteActuator(table=[(2, 0, 0, 0)])
    with pytest.raises(ParameterError, match="expected at least 1 entries"):
        DiscreteActuator(table=[])


def test_a_handler_takes_the_tables_place() -> None:
    taken: list[tuple[str, int]] = []
    actuator = DiscreteActuator(size=9, action_name="choice")
    actuator.handler = lambda body, index: taken.append((body.name, index))
    sim = sim_with(actuator, 0, 8)
    sim.step()
    assert taken == [("robot", 8)]
    assert sim.agents[0].body.position == (0, 0)


def test_a_script_turns_numbers_into_motion() -> None:
    actuator = ContinuousActuator(size=2)

    def hover(body: Body, numbers: tuple[float, ...]) -> None:
        body.set_velocity(numbers[0], numbers[1])

    actuator.handler = hover
    sim = sim_with(actuator, 0, [0.5, -3])
    sim.step()
    assert sim.agents[0].last_action == {"continuous": (0.5, -1.0)}
    assert sim.agents[0].body.velocity == pytest.approx((0.5, -1), rel=0.1)
    assert ContinuousActuator().limits() == ([-1.0] * 5, [1.0] * 5)


def test_nobody_takes_the_numbers() -> None:
    sim = sim_with(ContinuousActuator(size=1), 0, [0])
    with pytest.raises(BlockError) as caught:
        sim.step()
    assert str(caught.value) == (
        "agent '0', ContinuousActuator 'continuous': nobody takes its numbers; expected a "
        "function, as in actuator.handler = lambda body, numbers: ..."
    )
