"""Drives to the nearest corner of the house, and round it from there with the pen down."""

import math

from ai4u_edu import Controller

CORNERS = [(-2, -2), (2, -2), (2, 1), (0, 3), (-2, 1)]


class Drawer(Controller):
    def on_reset(self, agent, view):
        self.goal = None
        self.passed = 0

    def get_action(self, percept):
        x, y = percept["position"][0], percept["position"][1]
        heading = math.atan2(percept["heading"][0], percept["heading"][1])
        far = [math.hypot(x - a, y - b) for a, b in CORNERS]
        if self.goal is None:
            self.goal = far.index(min(far))
        if far[self.goal] < 0.15:
            self.goal, self.passed = (self.goal + 1) % 5, self.passed + 1
        to_x, to_y = CORNERS[self.goal]
        angle = math.remainder(math.atan2(to_y - y, to_x - x) - heading, 2 * math.pi)
        ahead = max(0, math.cos(angle)) ** 8
        return {"move": [ahead, max(-1, min(1, -3 * angle)), 0, 0], "pen": [self.passed > 0]}
