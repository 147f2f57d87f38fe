"""The reward functions: one idea a file."""

from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.blocks.rewards.min_dist import MinDistReward
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.blocks.rewards.touch import TouchRewardFunc

__all__ = ["FallReward", "MinDistReward", "RewardFunc", "TouchRewardFunc"]
