"""Goes to the nearest of what it lacks most; stays where it is while it lacks nothing."""

import math

FOOD, WATER = 1, 2
ENOUGH = 0.55


def decide(percept):
    energy, water = percept["inside"]
    if min(energy, water) > ENOUGH:
        return {"move": [0, 0, 0, 0]}
    wanted = FOOD if energy < water else WATER
    codes, distances = percept["vision"][::2], percept["vision"][1::2]
    seen = [(far, ray) for ray, far in enumerate(distances) if round(3 * codes[ray]) == wanted]
    if not seen:
        return {"move": [1.0, 0.3, 0, 0]}  # looks for some
    _, ray = min(seen)
    angle = 2 * math.pi * (ray + 1) / (len(codes) + 1) - math.pi
    ahead = max(0.2, math.cos(angle))  # never on the spot: things hide behind one another
    return {"move": [ahead, max(-1, min(1, -2 * angle)), 0, 0]}
