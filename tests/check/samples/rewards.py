"""Samples of reward functions whose defaults do not suit the checks' world."""

from ai4u_edu import (
    AndRewardFunc,
    BodyInAreaRewardFunc,
    CheckpointsReward,
    DistanceToTargetRewardFunc,
    DynamicFallReward,
    EvalBoolValue,
    EvalFloatValue,
    EvalIntValue,
    EventRewardFunc,
    FallReward,
    FigureReward,
    GoneReward,
    HomeostaticReward,
    HomeostaticVariable,
    MinDistReward,
    OrRewardFunc,
    ParkedRewardFunc,
    ProgressReward,
    TargetFallReward,
    TouchRewardFunc,
)
from tests.check.samples.sample import Sample

ALONE = "conditions pay nothing on their own"
ON_GROUND = EvalBoolValue(property="on_ground")
FAST = EvalFloatValue(property="speed", min_value=1, max_value=9)
ENERGY = HomeostaticVariable(name="energy", comfort_min=0.6, drift_per_second=-0.2)

SAMPLES = (
    AndRewardFunc(children=[ON_GROUND, FAST]),
    BodyInAreaRewardFunc(thing="step", area="goal"),
    CheckpointsReward(targets=["goal", "box"], loop=True),
    DistanceToTargetRewardFunc(target="box"),
    EventRewardFunc(event="touch", target="box"),
    DynamicFallReward(reference="other", threshold=0.1),
    Sample(ON_GROUND, always_same=ALONE),
    Sample(FAST, always_same=ALONE),
    Sample(EvalIntValue(property="steps", min_value=2, max_value=5), always_same=ALONE),
    Sample(FigureReward(group="goal"), always_same="nobody draws there"),
    Sample(GoneReward(group="target"), always_same="nothing is removed there"),
    HomeostaticReward(variables=[ENERGY]),
    MinDistReward(target="box"),
    OrRewardFunc(children=[EvalIntValue(property="steps", min_value=3, max_value=5), FallReward()]),
    Sample(ParkedRewardFunc(area="goal"), always_same="random actions do not park"),
    ProgressReward(target="box"),
    TargetFallReward(target="robot"),
    TouchRewardFunc(target="box", reward=1, only_one_time=False),
)
