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
    AStarController,
    BasicAgent,
    BearingSensor,
    Block,
    Body,
    BodyInAreaRewardFunc,
    BreadthFirstController,
    CarActuator,
    CBMoveActuator,
    CellSensor,
    CheckpointsReward,
    CollectActuator,
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
    FleeController,
    FloatArrayCompositeSensor,
    ForceMoveActuator,
    GoneReward,
    GrabActuator,
    GridMoveActuator,
    GridSensor,
    GroundStatusSensor,
    GroupTouchSensor,
    HeadingSensor,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    IDSensor,
    KeeperController,
    LightSensor,
    LinearRayCastingSensor,
    LineSensor,
    LocalBrain,
    LocalGridSensor,
    MinDistReward,
    NeuralNetController,
    OrientationSensor,
    OrRewardFunc,
    ParkedRewardFunc,
    PositionSensor,
    PresenceSensor,
    ProgressReward,
    PushOutController,
    RayCastingSensor,
    RBMoveActuator,
    RemoteBrain,
    ReplayController,
    RespawnActuator,
    RestlessnessRewardFunc,
    RewardSensor,
    ScriptController,
    StepSensor,
    StrikerController,
    TargetFallReward,
    TouchRewardFunc,
    TouchSensor,
    TrainController,
    Trainer,
    TruncatedSensor,
    VelocitySensor,
    WASDController,
    WASDRBMoveController,
)
from ai4u_edu.blocks import Actuator, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.scenes.serialization import KINDS

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


class Weaving(Trainer):
    """Drives to the left and to the right in turns."""

    def on_reset(self) -> None:
        self.side = 1

    def state_updated(self, percept: Any) -> None:
        self.side = -self.side
        self.controller.request_continuous_action("move", [1, self.side, 0, 0])


def trained() -> TrainController:
    controller = TrainController()
    controller.trainer = Weaving()
    return controller


def energy() -> HomeostaticVariable:
    return HomeostaticVariable(name="energy", comfort_min=0.6, drift_per_second=-0.2)


SAMPLES: tuple[Block, ...] = (
    ActionSensor(),
    AgentArraySensor(size=2),
    AreaOrientationSensor(target_group="target", group_code={"target": 2, "wall": 4}, radius=3),
    BearingSensor(target="box"),
    CellSensor(rows=14, columns=14, cell_size=0.5),
    DoneSensor(),
    FloatArrayCompositeSensor(sensors=[BearingSensor(target="box"), HeadingSensor()]),
    GridSensor(rows=14, columns=14, cell_size=0.5, group_code=CODES, self_exclude=False),
    GroundStatusSensor(),
    GroupTouchSensor(group="target"),
    HeadingSensor(),
    HomeostaticSensor(),
    IDSensor(),
    LineSensor(group="goal"),
    LightSensor(group="target", angle_deg=40),
    LinearRayCastingSensor(group_code=CODES, return_distance=True),
    LocalGridSensor(width=16, height=16, cell_size=0.5, stacked_observations=2),
    OrientationSensor(target="box", visibility_test=True),
    PositionSensor(),
    PresenceSensor(group="target"),
    RayCastingSensor(rows=3, columns=5, group_code=CODES, return_distance=True),
    RewardSensor(),
    StepSensor(),
    TouchSensor(target="box"),
    TruncatedSensor(),
    VelocitySensor(noise=0.1, delay=1, stacked_observations=2, dropout=0.1),
    CarActuator(max_speed=3),
    CBMoveActuator(move_amount=3, turn_amount=3, move_noise=0.2, turn_noise=0.2, jump_noise=0.2),
    CollectActuator(group="target", adds={"energy": 0.3}, comes_back_after=1),
    pushing(),
    DifferentialDriveActuator(max_wheel_speed=3),
    DiscreteActuator(move_amount=3, turn_amount=3),
    ForceMoveActuator(force=20),
    GrabActuator(angle=360),
    GridMoveActuator(rows=7, columns=7),
    RBMoveActuator(),
    RespawnActuator(poses=[(0, 0, 0), (2, -2, 90)], randomise_heading=True),
    AndRewardFunc(
        children=[
            EvalBoolValue(property="on_ground"),
            EvalFloatValue(property="speed", min_value=1, max_value=9),
        ]
    ),
    BodyInAreaRewardFunc(thing="step", area="goal"),
    CheckpointsReward(targets=["goal", "box"], loop=True),
    CollisionWithRewardFunc(),
    DistanceToTargetRewardFunc(target="box"),
    DynamicFallReward(reference="other", threshold=0.1),
    EvalBoolValue(property="on_ground"),
    EvalFloatValue(property="speed", min_value=1, max_value=9),
    EvalIntValue(property="steps", min_value=2, max_value=5),
    FallReward(),
    GoneReward(group="target"),
    HomeostaticReward(variables=[energy()]),
    MinDistReward(target="box"),
    OrRewardFunc(children=[EvalIntValue(property="steps", min_value=3, max_value=5), FallReward()]),
    ParkedRewardFunc(area="goal"),
    ProgressReward(target="box"),
    RestlessnessRewardFunc(),
    TargetFallReward(target="robot"),
    TouchRewardFunc(target="box", reward=1, only_one_time=False),
    LocalBrain(controller=WASDRBMoveController()),
    AStarController(),
    ArrowController(),
    BreadthFirstController(),
    DiscreteArrowController(),
    FleeController(pursuer="runner 1"),
    KeeperController(),
    PushOutController(),
    RemoteBrain(port=9),  # nobody listens there: it waits
    NeuralNetController(model_path="zoo:box_chase"),
    ReplayController(actions=[{"move": [1, 0, 0, 0]}, {"move": [0, 1, 0, 0]}], ending="repeat"),
    ScriptController(function=circle),
    StrikerController(),
    trained(),
    WASDController(),
    WASDRBMoveController(),
)

INSIDE_OTHERS: tuple[type[Block], ...] = (HomeostaticVariable,)
"""What no agent has on its own; checked inside the block that has it."""

ACTUATORS: dict[str, list[Actuator]] = {"DiscreteArrowController": [DiscreteActuator()]}

SCENES = {
    "AStarController": "grid_world",
    "BreadthFirstController": "grid_world",
    "FleeController": "tag",
    "KeeperController": "soccer",
    "NeuralNetController": "box_chase",
    "PushOutController": "sumo",
    "StrikerController": "soccer",
}
"""Where a block is checked for which the standard world has not what it needs."""


def tell(agent: BasicAgent, decision: int) -> None:
    """What a script does in a check: it tells the agent something, and takes a thing away."""
    if decision == 90 and "ball" in agent.view:
        ball = agent.view["ball"]
        assert isinstance(ball, Body)
        ball.leave()
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
