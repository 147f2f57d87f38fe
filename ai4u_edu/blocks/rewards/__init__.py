"""The reward functions: one idea a file."""

from ai4u_edu.blocks.rewards.collision import CollisionWithRewardFunc
from ai4u_edu.blocks.rewards.combined import AndRewardFunc, OrRewardFunc
from ai4u_edu.blocks.rewards.distance_to_target import DistanceToTargetRewardFunc
from ai4u_edu.blocks.rewards.dynamic_fall import DynamicFallReward
from ai4u_edu.blocks.rewards.eval_value import EvalBoolValue, EvalFloatValue, EvalIntValue
from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.blocks.rewards.homeostatic import HomeostaticReward
from ai4u_edu.blocks.rewards.min_dist import MinDistReward
from ai4u_edu.blocks.rewards.restlessness import RestlessnessRewardFunc
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.blocks.rewards.touch import TouchRewardFunc

__all__ = [
    "AndRewardFunc",
    "CollisionWithRewardFunc",
    "DistanceToTargetRewardFunc",
    "DynamicFallReward",
    "EvalBoolValue",
    "EvalFloatValue",
    "EvalIntValue",
    "FallReward",
    "HomeostaticReward",
    "MinDistReward",
    "OrRewardFunc",
    "RestlessnessRewardFunc",
    "RewardFunc",
    "TouchRewardFunc",
]
