"""How the yardstick's robot is driven: in bends, so that it meets boxes and walls."""

import numpy as np
import numpy.typing as npt


def course(steps: int, seed: int) -> npt.NDArray[np.float32]:
    """(steps, 2) actions; the first ones are the same however many there are."""
    chance = np.random.default_rng(seed)
    bends = np.sin(np.arange(steps) / chance.uniform(5, 15))
    forward, jitter = chance.uniform([0.3, -0.3], [1.0, 0.3], (steps, 2)).T
    return np.column_stack([forward, bends + jitter]).astype(np.float32)
