# %% tags=["solution"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
            self.speed = -self.speed
        if self.bumps >= 3:
            return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["right", "a word for the direction"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    direction = "forward"
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps += 1
            self.direction = "backward" if self.direction == "forward" else "forward"
        if self.bumps > 2:
            return {"move": [0, 0, 0, 0]}
        return {"move": [1 if self.direction == "forward" else -1, 0, 0, 0]}


# %% tags=["right", "by the count alone"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
        speeds = [1, -1, 1, 0]
        return {"move": [speeds[min(self.bumps, 3)], 0, 0, 0]}


# %% tags=["right", "a list of the bumps"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    def __init__(self):
        self.bumps = []

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps.append("bump")
        if len(self.bumps) > 2:
            return {"move": [0, 0, 0, 0]}
        return {"move": [(-1) ** len(self.bumps), 0, 0, 0]}


# %% tags=["wrong", "begin", "backward only while it bumps"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            return {"move": [-1, 0, 0, 0]}
        return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "back", "sets -1 each time"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
            self.speed = -1
        if self.bumps >= 3:
            return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "on", "never rests"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.speed = -self.speed
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "still", "rests for one decision"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
            self.speed = -self.speed
            if self.bumps == 3:
                self.bumps = 0
                return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "still", "exactly three"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
            self.speed = -self.speed
        if self.bumps == 3:
            return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "early", "counts decisions"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        self.bumps = self.bumps + 1
        if percept["bumper"][0] == 1:
            self.speed = -self.speed
        if self.bumps >= 36:
            return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "error", "a name without self"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            bumps = bumps + 1
            speed = -speed
        if bumps >= 3:
            return {"move": [0, 0, 0, 0]}
        return {"move": [speed, 0, 0, 0]}


# %% tags=["wrong", "on", "starts the count again"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1

    def get_action(self, percept):
        bumps = 0
        if percept["bumper"][0] == 1:
            bumps = bumps + 1
            self.speed = -self.speed
        if bumps >= 3:
            return {"move": [0, 0, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["wrong", "no-base", "no Controller"]
class ThreeBumps:
    """Drives to and fro, and rests after the third bump."""

    speed = 1

    def get_action(self, percept):
        return {"move": [self.speed, 0, 0, 0]}


# %% tags=["lucky", "by the clock"]
count = 0


def ThreeBumps(percept):
    global count
    count = count + 1
    if count < 30:
        return {"move": [1, 0, 0, 0]}
    if count < 80:
        return {"move": [-1, 0, 0, 0]}
    return {"move": [1 if count < 130 else 0, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def ThreeBumps(percept):
    return {"move": [random.choice([-1, 1]), 0, 0, 0]}


# %% tags=["lucky", "stops at the first wall"]
def ThreeBumps(percept):
    if percept["bumper"][0] == 1:
        return {"move": [0, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "by the clock, longer than any way"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        if self.count <= 40:
            return {"move": [1, 0, 0, 0]}
        if self.count <= 110:
            return {"move": [-1, 0, 0, 0]}
        return {"move": [1 if self.count <= 180 else 0, 0, 0, 0]}


# %% tags=["wrong", "spins", "turns on the spot after the third bump"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1
    bumps = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.bumps = self.bumps + 1
            self.speed = -self.speed
        if self.bumps >= 3:
            return {"move": [0, 1, 0, 0]}
        return {"move": [self.speed, 0, 0, 0]}
