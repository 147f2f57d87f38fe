"""Eats the fruit, then goes east: it leaps from edge to edge, and round the spike to the exit."""

import math

NOTHING, RIGHT, LEFT, AHEAD, LEAP = range(5)
FRUIT, SPIKE = 1, 3
EDGES = [(3.5, 1.0), (13.0, 1.0), (22.5, -1.0)]  # x of an eastern edge, y of a way across the gap


class Runner:
    def reset(self):
        self.fruit = self.spike = None

    def get_action(self, percept):
        x, y = percept["position"][0] * 37.0, percept["position"][1] * 10.5
        sine, cosine = percept["heading"]
        heading = math.atan2(sine, cosine)
        self.fruit = found(percept, FRUIT, x, y, heading) or self.fruit
        self.spike = self.spike or found(percept, SPIKE, x, y, heading)
        ahead = [edge for edge in EDGES if x < edge[0]]
        is_hungry = percept["inside"][0] < 0.25
        leap = False
        if is_hungry and self.fruit and (not ahead or self.fruit[0] < ahead[0][0]):
            goal = self.fruit
        elif ahead:
            edge, level = ahead[0]
            on_line = abs(y - level) < 0.6
            leap = on_line and x > edge - 0.8
            goal = (edge + 3.0, level) if on_line else (edge - 1.6, level)
        else:
            goal = goal_on_the_last(self.spike or (x, -2.0), x)
        aside = math.remainder(math.atan2(goal[1] - y, goal[0] - x) - heading, 2 * math.pi)
        if abs(aside) > 0.2:
            return {"move": LEFT if aside > 0 else RIGHT}
        return {"move": LEAP if leap else AHEAD}


def found(percept, code, x, y, heading):
    """Return a visible thing's position in the world, the mean of the rays that hit it."""
    codes, distances = percept["around"][::2], percept["around"][1::2]
    seen = [ray for ray, each in enumerate(codes) if round(3 * each) == code]
    if not seen:
        return None
    angles = [heading + 2 * math.pi * (ray + 1) / (len(codes) + 1) - math.pi for ray in seen]
    angle = math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles)))
    far = 12 * min(distances[ray] for ray in seen) + 0.4
    return x + far * math.cos(angle), y + far * math.sin(angle)


def goal_on_the_last(spike, x):
    """Return the exit, once it is past the spike; before, a way round it."""
    if x > spike[0] + 0.8:
        return 31.0, -2.0
    return x + 1.2, spike[1] + (1.9 if spike[1] < -1.5 else -1.9)
