"""Straight at the other one, at full speed; from near the edge back to the middle."""

import math

METRES = 9.0  # what a position of 1 is: the ring's radius and 5 m


def decide(percept):
    x, y = METRES * percept["position"][0], METRES * percept["position"][1]
    forward, left, _ = percept["opponent"]
    angle = math.atan2(left, forward)
    if math.hypot(x, y) > 3.2 and math.cos(angle) < 0.9:
        sine, cosine = percept["heading"]
        angle = math.remainder(math.atan2(-y, -x) - math.atan2(sine, cosine), 2 * math.pi)
    ahead = 1.0 if math.cos(angle) > 0.9 else 0
    return {"move": [ahead, max(-1, min(1, -2 * angle)), 0, 0]}
