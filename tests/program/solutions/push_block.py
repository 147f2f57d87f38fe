"""Goes round the block to its far side, seen from the field; then pushes, and steers by the rest.

All places are in the robot's own frame: x forward, y left.
"""

import math

PLATE = math.hypot(11, 11) + 5  # what the readings are divided by, metres


def decide(percept):
    x, y = percept["block"][0] * PLATE, percept["block"][1] * PLATE
    way_x, way_y = percept["field"][0] * PLATE - x, percept["field"][1] * PLATE - y
    far = math.hypot(way_x, way_y)
    way_x, way_y = way_x / far, way_y / far
    # along, left: where the robot is, seen from the block, with the field ahead
    along, left = -x * way_x - y * way_y, -way_x * y + way_y * x
    if along < -0.5 and abs(left) < 0.35:
        ahead, aside = 0.4, 0.0  # right behind it: push
    elif along < -0.5:
        ahead, aside = -1.7, 0.0
    else:  # beside or before it: out and past it
        ahead, aside = -1.2, 1.8 if left >= 0 else -1.8
    angle = math.atan2(
        y + ahead * way_y + aside * way_x,
        x + ahead * way_x - aside * way_y,
    )
    forward = 1.0 if math.cos(angle) > 0.9 else 0
    return {"move": [forward, max(-1, min(1, -2 * angle)), 0, 0]}
