"""Goes behind the ball, seen from the goal, and then through it."""

import math

METRES = math.hypot(16.2, 9.2) + 5  # what a position of 1 is


class Forward:
    def reset(self):
        self.stuck = 0

    def get_action(self, percept):
        is_slow = abs(percept["velocity"][0]) < 1
        self.stuck = self.stuck + 1 if is_slow or self.stuck > 10 else 0
        if self.stuck > 10:  # somebody pushes as hard as it does
            self.stuck %= 18
            return {"move": [-1, 0.5, 0, 0]}
        x, y = METRES * percept["ball"][0], METRES * percept["ball"][1]
        goal_x, goal_y = METRES * percept["goal"][0], METRES * percept["goal"][1]
        home_x, home_y = METRES * percept["home"][0], METRES * percept["home"][1]
        far = math.hypot(goal_x - x, goal_y - y)
        shot_x, shot_y = (goal_x - x) / far, (goal_y - y) / far
        before, beside = x * shot_x + y * shot_y, -x * shot_y + y * shot_x
        if before > 0 and abs(beside) < (1.2 if before < 1 else 0.4) * before:
            ahead, aside = 0.3, 0.0
        elif before > 0:
            ahead, aside = -1.2, 0.0
        else:  # it is in the way: round it, on the side of the middle
            middle_x, middle_y = (goal_x + home_x) / 2 - x, (goal_y + home_y) / 2 - y
            ahead, aside = -1.0, math.copysign(1.2, -middle_x * shot_y + middle_y * shot_x)
        angle = math.atan2(
            y + ahead * shot_y + aside * shot_x,
            x + ahead * shot_x - aside * shot_y,
        )
        forward = 1.0 if math.cos(angle) > 0.9 else 0
        return {"move": [forward, max(-1, min(1, -2 * angle)), 0, 0]}
