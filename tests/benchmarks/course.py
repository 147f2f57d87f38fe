"""A course for the yardstick's robot: in curves, so that it meets boxes and walls."""

import numpy as np
import numpy.typing as npt


def course(steps: int, seed: int) -> npt.NDArray[np.float32]:
    """Return actions of shape (steps, 2); a longer course begins with the shorter one."""
    rng = np.random.default_rng(seed)
    bends = np.sin(np.arange(steps) / rng.uniform(5, 15))
    forward, jitter = rng.uniform([0.3, -0.3], [1.0, 0.3], (steps, 2)).T
    return np.column_stack([forward, (bends + jitter).clip(-1.0, 1.0)]).astype(np.float32)
