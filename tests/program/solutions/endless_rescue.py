"""Follows the line, turns at green marks, drives around obstacles, and finds the victim.

The drive is one long function that stops at each yield until the next percept comes.
"""

import math

from ai4u_edu import Controller

SPEED = 0.5  # of both wheels: 1 metre in 12 decisions
GAP = 14  # decisions straight on, which lead over a gap
OBSTACLE, VICTIM = 1 / 3, 1.0  # codes of the rays


class Rescuer(Controller):
    def on_reset(self, agent, view):
        self.course = None

    def get_action(self, percept):
        if self.course is None:
            self.course = rescue(percept)
            return next(self.course)
        return self.course.send(percept)


def rescue(percept):
    left, lost, side = 0.0, 0, 0
    while not is_grey(percept["left_colour"]) and not is_grey(percept["right_colour"]):
        eyes = percept["line"]
        if is_green(percept["left_colour"]):
            side = 1
        if is_green(percept["right_colour"]):
            side = -1
        if way_to_obstacle(percept) < 0.75:
            percept = yield from around_obstacle(percept)
            left, lost = 0.0, 0
        elif side and eyes[0 if side > 0 else 4]:
            percept = yield from straight(percept, 4)
            percept = yield from turn(percept, side * math.pi / 2)
            percept = yield from straight(percept, 4)  # past the mark, which it sees once more
            left, lost, side = 0.0, 0, 0
        elif eyes[2] and (eyes[0] or eyes[4]):  # a crossing without a mark
            left, lost = 0.0, 0
            percept = yield move(SPEED, SPEED)
        elif eyes.any():
            lost = 0
            left = sum(a * b for a, b in zip(eyes, [1, 0.5, 0, -0.5, -1])) / eyes.sum()
            percept = yield move(SPEED - 0.45 * left, SPEED + 0.45 * left)
        else:
            lost += 1
            if lost <= GAP and abs(left) < 0.6:
                percept = yield move(SPEED, SPEED)
            else:
                spin = 0.35 if left >= 0 else -0.35
                percept = yield move(-spin, spin)
    percept = yield from straight(percept, 13)  # into the room
    while True:
        codes = percept["vision"][::2]
        seen = [15 * ray - 90 for ray, code in enumerate(codes) if abs(code - VICTIM) < 0.01]
        if seen:
            angle = math.radians(sum(seen) / len(seen))
            percept = yield move(0.4 - 0.4 * angle, 0.4 + 0.4 * angle)
        else:
            percept = yield move(-0.2, 0.2)


def around_obstacle(percept):
    """Drive three sides of a rectangle, with the obstacle at the left."""
    percept = yield from turn(percept, -math.pi / 2)
    percept = yield from straight(percept, 9)
    percept = yield from turn(percept, math.pi / 2)
    percept = yield from straight(percept, 18)
    percept = yield from turn(percept, math.pi / 2)
    while not percept["line"].any():
        percept = yield move(0.3, 0.3)
    percept = yield from straight(percept, 4)
    return (yield from turn(percept, -math.pi / 2))


def straight(percept, decisions):
    for _ in range(decisions):
        percept = yield move(SPEED, SPEED)
    return percept


def turn(percept, angle):
    """Turn on the spot by an angle, to a multiple of a quarter turn."""
    goal = round((heading(percept) + angle) / (math.pi / 2)) * math.pi / 2
    error = math.remainder(goal - heading(percept), 2 * math.pi)
    while abs(error) > 0.05:
        power = max(-0.5, min(0.5, 1.5 * error))
        percept = yield move(-power, power)
        error = math.remainder(goal - heading(percept), 2 * math.pi)
    return percept


def heading(percept):
    sine, cosine = percept["heading"]
    return math.atan2(sine, cosine)


def move(left, right):
    return {"move": [max(-1, min(1, left)), max(-1, min(1, right))]}


def way_to_obstacle(percept):
    code, share = percept["vision"][12:14]  # of the ray straight ahead
    return 6 * share if abs(code - OBSTACLE) < 0.01 else math.inf


def is_green(colour):
    return colour[1] > colour[0] + 0.3  # green and red


def is_grey(colour):
    return 0.4 < colour[3] < 0.7 and not is_green(colour)  # brightness
