"""Advantages and probabilities are those of Stable-Baselines3."""

import numpy as np
import pytest
import torch
from gymnasium import spaces
from stable_baselines3.common.buffers import RolloutBuffer

from ai4u_edu.learn.small.ppo import advantages

pytestmark = pytest.mark.needs("train")

STEPS, WORLDS, DISCOUNT, TRUST = 40, 6, 0.97, 0.9


def test_advantages_are_those_of_stable_baselines3() -> None:
    generator = np.random.default_rng(0)
    shape = STEPS, WORLDS
    rewards = generator.normal(size=shape).astype(np.float32)
    values = generator.normal(size=(STEPS + 1, WORLDS)).astype(np.float32)
    terminated = generator.random(shape) < 0.1
    truncated = (generator.random(shape) < 0.1) & ~terminated
    last_values = generator.normal(size=shape).astype(np.float32)  # where an episode was cut off
    is_over = terminated | truncated

    one = spaces.Box(-1, 1, (1,))
    buffer = RolloutBuffer(STEPS, one, one, "cpu", TRUST, DISCOUNT, WORLDS)
    begins = np.ones(WORLDS, np.bool_)
    for step in range(STEPS):
        # its algorithms add the value at a cut to the reward
        paid = rewards[step] + np.where(truncated[step], DISCOUNT * last_values[step], 0.0)
        nothing = np.zeros((WORLDS, 1), np.float32)
        value, chance = torch.from_numpy(values[step]), torch.zeros(WORLDS)
        buffer.add(nothing, nothing, paid, begins, value, chance)
        begins = is_over[step]
    buffer.compute_returns_and_advantage(torch.from_numpy(values[-1]), begins)

    next_values = values[1:].copy()
    next_values[terminated] = 0.0
    next_values[truncated] = last_values[truncated]
    found = advantages(rewards, values[:-1], next_values, ~is_over, DISCOUNT, TRUST)
    np.testing.assert_allclose(found, buffer.advantages, atol=1e-5)
    np.testing.assert_allclose(found + values[:-1], buffer.returns, atol=1e-5)
