"""Keeps a wall at its right hand; goes for the exit when it sees it."""

import math

from ai4u_edu import Controller


class Explorer(Controller):
    distance: float = 0.8

    def on_reset(self, agent, view):
        self.seen = 0

    def get_action(self, percept):
        codes, far = percept["vision"][::2], percept["vision"][1::2] * 12
        exits = [math.radians(15 * ray - 90) for ray, code in enumerate(codes) if code == 1.0]
        if exits:
            self.seen += 1
            angle = sum(exits) / len(exits)
            ahead = 1.0 if math.cos(angle) > 0.9 else 0
            return {"move": [ahead, max(-1, min(1, -2 * angle)), 0, 0]}
        if far[5:8].min() < 0.85:  # a wall ahead
            return {"move": [0, -1, 0, 0]}
        right = max(-1.0, min(1.0, far[:5].min() - self.distance))
        return {"move": [0.8 - 0.4 * abs(right), right, 0, 0]}
