"""The reward functions: one idea a file."""

from ai4u_edu.blocks.rewards.body_in_area import BodyInAreaRewardFunc
from ai4u_edu.blocks.rewards.checkpoints import CheckpointsReward
from ai4u_edu.blocks.rewards.collision import CollisionWithRewardFunc
from ai4u_edu.blocks.rewards.combined import AndRewardFunc, OrRewardFunc
from ai4u_edu.blocks.rewards.distance_to_target import DistanceToTargetRewardFunc
from ai4u_edu.blocks.rewards.dynamic_fall import DynamicFallReward
from ai4u_edu.blocks.rewards.eval_value import EvalBoolValue, EvalFloatValue, EvalIntValue
from ai4u_edu.blocks.rewards.event import EventRewardFunc
from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.blocks.rewards.figure import FigureReward
from ai4u_edu.blocks.rewards.gone import GoneReward
from ai4u_edu.blocks.rewards.homeostatic import HomeostaticReward
from ai4u_edu.blocks.rewards.min_dist import MinDistReward
from ai4u_edu.blocks.rewards.parked import ParkedRewardFunc
from ai4u_edu.blocks.rewards.progress import ProgressReward
from ai4u_edu.blocks.rewards.restlessness import RestlessnessRewardFunc
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.blocks.rewards.target_fall import TargetFallReward
from ai4u_edu.blocks.rewards.touch import TouchRewardFunc

__all__ = [
    "AndRewardFunc",
    "BodyInAreaRewardFunc",
    "CheckpointsReward",
    "CollisionWithRewardFunc",
    "DistanceToTargetRewardFunc",
    "DynamicFallReward",
    "EvalBoolValue",
    "EvalFloatValue",
    "EvalIntValue",
    "EventRewardFunc",
    "FallReward",
    "FigureReward",
    "GoneReward",
    "HomeostaticReward",
    "MinDistReward",
    "OrRewardFunc",
    "ParkedRewardFunc",
    "ProgressReward",
    "RestlessnessRewardFunc",
    "RewardFunc",
    "TargetFallReward",
    "TouchRewardFunc",
]
