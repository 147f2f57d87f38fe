"""After the nearest runner that is free, along a ray that is free."""

import math

METRES = math.hypot(14.2, 10.2) + 5  # what a position of 1 is
RUNNERS = ["runner 1", "runner 2", "runner 3"]
ANGLES = [2 * math.pi * (ray / 16 - 0.5) for ray in range(1, 16)]


def decide(percept):
    free = [name for name, there in zip(RUNNERS, percept["free"]) if there]
    away = {name: METRES * math.hypot(percept[name][0], percept[name][1]) for name in free}
    nearest = min(free, key=lambda name: away[name])
    forward, aside, _ = percept[nearest]
    angle = math.atan2(aside, forward)
    codes, rooms = percept["rays"][::2], percept["rays"][1::2] * 8
    is_wall = [code == 0.5 and room < min(1.5, away[nearest]) for code, room in zip(codes, rooms)]
    nearest_ray = min(range(15), key=lambda ray: abs(ANGLES[ray] - angle))
    if is_wall[nearest_ray]:
        best = max(range(15), key=lambda ray: math.cos(ANGLES[ray] - angle) - 3 * is_wall[ray])
        angle = ANGLES[best]
    return {"move": [1.0 if math.cos(angle) > 0.9 else 0, max(-1, min(1, -2 * angle)), 0, 0]}
