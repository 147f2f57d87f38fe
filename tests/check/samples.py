"""One block of every kind, with parameters that suit the standard world."""

import math
import sys
from typing import Any

from ai4u_edu import (
    ActionSensor,
    AgentArraySensor,
    AndRewardFunc,
    AreaOrientationSensor,
    ArrowController,
    BasicAgent,
    BearingSensor,
    Block,
    CBMoveActuator,
    CollisionWithRewardFunc,
    ContinuousActuator,
    DifferentialDriveActuator,
    DiscreteActuator,
    DiscreteArrowController,
    DistanceToTargetRewardFunc,
    DoneSensor,
    DynamicFallReward,
    EvalBoolValue,
    EvalFloatValue,
    EvalIntValue,
    FallReward,
    FloatArrayCompositeSensor,
    GrabActuator,
    GroundStatusSensor,
    GroupTouchSensor,
    HeadingSensor,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    IDSensor,
    LinearRayCastingSensor,
    LocalBrain,
    LocalGridSensor,
    MinDistReward,
    OrientationSensor,
    OrRewardFunc,
    PositionSensor,
    RayCastingSensor,
    RBMoveActuator,
    ReplayController,
    RespawnActuator,
    RestlessnessRewardFunc,
    RewardSensor,
    ScriptController,
    StepSensor,
    TouchRewardFunc,
    TouchSensor,
    TruncatedSensor,
    VelocitySensor,
    WASDRBMoveController,
)
from ai4u_edu.blocks import Actuator, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.scenes.plain import KINDS

CODES = {"floor": 1, "target": 2, "wall": 4, "agent": 8}


def push(body: Any, numbers: Any) -> None:
    """Pushes with all its numbers."""
    body.apply_force(20 * numbers[0], 20 * numbers[1])


def circle(percept: Any) -> dict[str, Any]:
    """Drives in circles."""
    return {"move": [1, 0.5, 0, 0]}


def pushing() -> ContinuousActuator:
    actuator = ContinuousActuator(size=2)
    actuator.handler = push
    return actuator


def energy() -> HomeostaticVariable:
    return HomeostaticVariable(name="energy", comfort_min=0.6, drift_per_second=-0.2)


SAMPLES: tuple[Block, ...] = (
    ActionSensor(),
    AgentArraySensor(size=2),
    AreaOrientationSensor(target_group="target", group_code=CODES, radius=3),
    BearingSensor(target="box"),
    DoneSensor(),
    FloatArrayCompositeSensor(sensors=[BearingSensor(target="box"), HeadingSensor()]),
    GroundStatusSensor(),
    GroupTouchSensor(group="target"),
    HeadingSensor(),
    HomeostaticSensor(),
    IDSensor(),
    LinearRayCastingSensor(group_code=CODES, return_distance=True),
    LocalGridSensor(width=16, height=16, cell_size=0.5, stacked_observations=2),
    OrientationSensor(target="box", visibility_test=True),
    PositionSensor(),
    RayCastingSensor(rows=3, columns=5, group_code=CODES, return_distance=True),
    RewardSensor(),
    StepSensor(),
    TouchSensor(target="box"),
    TruncatedSensor(),
    VelocitySensor(noise=0.1, delay=1, stacked_observations=2, dropout=0.1),
    CBMoveActuator(move_amount=3, turn_amount=3, move_noise=0.2, turn_noise=0.2, jump_noise=0.2),
    pushing(),
    DifferentialDriveActuator(max_wheel_speed=3),
    DiscreteActuator(move_amount=3, turn_amount=3),
    GrabActuator(angle=360),
    RBMoveActuator(),
    RespawnActuator(poses=[(0, 0, 0), (2, -2, 90)], randomise_heading=True),
    AndRewardFunc(
        children=[
            EvalBoolValue(property="on_ground"),
            EvalFloatValue(property="speed", min_value=1, max_value=9),
        ]
    ),
    CollisionWithRewardFunc(),
    DistanceToTargetRewardFunc(target="box"),
    DynamicFallReward(reference="other", threshold=0.1),
    EvalBoolValue(property="on_ground"),
    EvalFloatValue(property="speed", min_value=1, max_value=9),
    EvalIntValue(property="steps", min_value=2, max_value=5),
    FallReward(),
    HomeostaticReward(variables=[energy()]),
    MinDistReward(target="box"),
    OrRewardFunc(children=[EvalIntValue(property="steps", min_value=3, max_value=5), FallReward()]),
    RestlessnessRewardFunc(),
    TouchRewardFunc(target="box", reward=1, only_one_time=False),
    LocalBrain(controller=WASDRBMoveController()),
    ArrowController(),
    DiscreteArrowController(),
    ReplayController(actions=[{"move": [1, 0, 0, 0]}, {"move": [0, 1, 0, 0]}], ending="repeat"),
    ScriptController(function=circle),
    WASDRBMoveController(),
)

INSIDE_OTHERS: tuple[type[Block], ...] = (HomeostaticVariable,)
"""What no agent has on its own; checked inside the block that has it."""

ACTUATORS: dict[str, list[Actuator]] = {"DiscreteArrowController": [DiscreteActuator()]}


def tell(agent: BasicAgent, decision: int) -> None:
    """What a script does in a check: it tells the agent something."""
    for sensor in agent.sensors:
        if isinstance(sensor, AgentArraySensor):
            sensor.set_value(0, abs(math.sin(decision)))


def built_in_kinds() -> list[type[Block]]:
    """All kinds of blocks of the package that an agent can have."""
    return [
        cls
        for cls in Block.types.values()
        if cls.__module__.startswith("ai4u_edu.")
        and vars(sys.modules[cls.__module__]).get(cls.__name__) is cls  # no docstring's example
        and cls not in (*KINDS, *INSIDE_OTHERS)
        and not cls.__dict__.get("abstract")
    ]


__all__ = ["SAMPLES", "Brain", "Controller", "RewardFunc", "Sensor", "built_in_kinds"]
