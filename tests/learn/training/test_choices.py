"""The actions that DQN chooses from."""

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu.learn.training.worlds import table_for

pytestmark = pytest.mark.needs("train")


def test_default_actions_are_rest_and_each_number_at_its_ends() -> None:
    low, high = np.array([-1, 0], np.float32), np.array([1, 1], np.float32)
    assert table_for(Box(low, high)).tolist() == [[0, 0], [-1, 0], [1, 0], [0, 1]]
