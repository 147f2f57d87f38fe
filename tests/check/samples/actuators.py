"""Samples of actuators whose defaults do not suit the checks' world."""

from typing import Any

from ai4u_edu import (
    CarActuator,
    CBMoveActuator,
    CollectActuator,
    ContinuousActuator,
    DifferentialDriveActuator,
    DiscreteActuator,
    ForceMoveActuator,
    GrabActuator,
    GridMoveActuator,
    PenActuator,
    RespawnActuator,
)


def push(body: Any, numbers: Any) -> None:
    """Push a body with a force made of both numbers."""
    body.apply_force(20 * numbers[0], 20 * numbers[1])


def pushing() -> ContinuousActuator:
    actuator = ContinuousActuator(size=2)
    actuator.handler = push
    return actuator


SAMPLES = (
    CarActuator(max_speed=3),
    CBMoveActuator(move_amount=3, turn_amount=3, move_noise=0.2, turn_noise=0.2, jump_noise=0.2),
    CollectActuator(group="target", adds={"energy": 0.3}, comes_back_after=1),
    pushing(),
    DifferentialDriveActuator(max_wheel_speed=3),
    DiscreteActuator(move_amount=3, turn_amount=3),
    ForceMoveActuator(force=20),
    GrabActuator(angle=360),
    GridMoveActuator(rows=7, columns=7),
    PenActuator(colours=["blue", "none"], max_width=0.5, ahead=0.2),
    RespawnActuator(poses=[(0, 0, 0), (2, -2, 90)], randomise_heading=True),
)
