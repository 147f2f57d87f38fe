"""Backs up along the lane until there is room for a quarter circle, and drives in on that."""

import math

RADIUS = 2.6  # a bit more than the car's smallest
BEHIND = 0.4  # the point that is led along the circle is so far behind the car's centre


class Driver:
    def reset(self):
        self.backing = True

    def get_action(self, percept):
        forward, left, _ = percept["bay"]
        sine, cosine = percept["heading"]
        heading = math.atan2(sine, cosine)
        across = cosine * (forward + BEHIND) - sine * left  # how far on along the lane the bay is
        deep = sine * forward + cosine * left
        up = math.copysign(1.0, deep)
        self.backing = self.backing and across < RADIUS + 0.2
        if self.backing:
            return {"move": [-0.6, max(-1, min(1, -2 * heading))]}
        on_circle = math.acos(max(0, min(1, 1 - abs(across) / RADIUS)))
        wanted = up * (math.pi / 2 - math.copysign(min(on_circle, 1.2 * abs(across)), across))
        askew = math.remainder(wanted - heading, 2 * math.pi)
        speed = 0.0 if up * deep < 0.1 else 0.5
        return {"move": [speed, max(-1, min(1, -5 * askew))]}
