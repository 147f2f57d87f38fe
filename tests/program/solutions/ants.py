"""Drives round the nest until it sees a trail, follows it to the food, and goes home."""

import math

from ai4u_edu import Controller


class Ant(Controller):
    def on_reset(self, agent, view):
        self.is_laden = False
        self.turning = 0

    def get_action(self, percept):
        nest = percept["nest"]
        self.is_laden = self.is_laden or percept["touch"][0] > 0
        if self.is_laden:
            return go(math.atan2(nest[1], nest[0]))
        codes = percept["rays"][::2]
        angles = [math.radians(120 * (ray + 1) / 7 - 60) for ray in range(6)]
        food = [angle for angle, code in zip(angles, codes) if code == 2]
        if food:
            return go(sum(food) / len(food))
        if self.turning:
            self.turning -= 1
            return go(math.atan2(-nest[1], -nest[0]))
        eyes = percept["line"]
        if eyes.any():
            if nest[0] > 0.3 and math.hypot(nest[0], nest[1]) > 1.5:
                self.turning = 10  # the trail leads to the nest, so the food is the other way
            side = sum(eye * (3 - n) / 3 for n, eye in enumerate(eyes)) / eyes.sum()
            return go(math.atan2(side, 1))
        # round the nest, so that it comes across each trail
        away = math.hypot(nest[0], nest[1]) - 2.2
        return go(math.atan2(nest[1], nest[0]) - math.pi / 2 + max(-0.8, min(0.8, away)))


def go(angle):
    ahead = max(0, math.cos(angle))
    return {"move": [ahead, max(-1, min(1, -2 * angle)), 0, 0]}
