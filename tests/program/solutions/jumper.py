"""Drives along the middle line, and leaps where a block ends."""

import math


def decide(percept):
    x, y = percept["position"][:2] * 35.0
    sine, cosine = percept["heading"]
    wanted = math.atan2(-y, 4.0) - math.atan2(sine, cosine)
    edge = (x + 2) % 7 > 3.3 and x < 27
    leap = 1.0 if edge and abs(wanted) < 0.3 else 0
    angle = math.atan2(math.sin(wanted), math.cos(wanted))
    return {"move": [1.0 if math.cos(wanted) > 0.9 else 0, max(-1, min(1, -2 * angle)), 0, leap]}
