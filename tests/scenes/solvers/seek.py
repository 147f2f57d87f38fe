"""Shared helper of several solvers: turn towards a target, and go."""

import math
from typing import Any

import numpy as np


def seek(cosine: float, sine: float, leap: float = 0.0) -> dict[str, Any]:
    """Turns towards a direction, and drives once it is about ahead."""
    ahead = 1.0 if cosine > 0.9 else 0.0
    return {"move": [ahead, -np.clip(2 * math.atan2(sine, cosine), -1, 1), 0, leap]}
