# %% tags=["solution"]
class AroundTheWall(Controller):
    """Gets to the box, although there is a wall in its way."""

    state = "seek"
    left = 0  # decisions that are left in this state

    def get_action(self, percept):
        bumps = percept["bumper"][0] == 1
        if self.state == "seek" and bumps:
            self.state, self.left = "back off", 6
        elif self.state == "back off" and self.left == 0:
            self.state, self.left = "aside", 20
        elif self.state == "aside" and self.left == 0:
            self.state = "seek"
        self.left = self.left - 1
        if self.state == "back off":
            return {"move": [-1, 0, 0, 0]}
        if self.state == "aside":
            turning = self.left >= 14  # the first decisions: a quarter turn to the right
            return {"move": [0, 1, 0, 0] if turning else [1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["wrong", "again"]
class AroundTheWall(Controller):
    """Backs off, and runs into the wall again."""

    state = "seek"
    left = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.left = 6
        self.left = self.left - 1
        if self.left > 0:
            return {"move": [-1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["wrong", "forever"]
class AroundTheWall(Controller):
    """Never leaves the state into which it comes by a bump."""

    state = "seek"

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.state = "back off"
        if self.state == "back off":
            return {"move": [-1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["right", "farther aside"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    state = "seek"
    left = 0

    def get_action(self, percept):
        bumps = percept["bumper"][0] == 1
        if self.state == "seek" and bumps:
            self.state, self.left = "back off", 6
        elif self.state == "back off" and self.left == 0:
            self.state, self.left = "aside", 30
        elif self.state == "aside" and self.left == 0:
            self.state = "seek"
        self.left = self.left - 1
        if self.state == "back off":
            return {"move": [-1, 0, 0, 0]}
        if self.state == "aside":
            return {"move": [0, 1, 0, 0] if self.left >= 24 else [1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["right", "the last bump counts"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    left = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.left = 36
        self.left = self.left - 1
        if self.left > 30:
            return {"move": [-1, 0, 0, 0]}
        if self.left > 24:
            return {"move": [0, 1, 0, 0]}
        if self.left > 0:
            return {"move": [1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["right", "values from __init__"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    def __init__(self):
        self.state = "seek"
        self.left = 0

    def get_action(self, percept):
        bumps = percept["bumper"][0] == 1
        if self.state == "seek" and bumps:
            self.state, self.left = "back off", 6
        elif self.state == "back off" and self.left == 0:
            self.state, self.left = "aside", 20
        elif self.state == "aside" and self.left == 0:
            self.state = "seek"
        self.left = self.left - 1
        if self.state == "back off":
            return {"move": [-1, 0, 0, 0]}
        if self.state == "aside":
            return {"move": [0, 1, 0, 0] if self.left >= 14 else [1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["wrong", "begin", "pushes on"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    state = "seek"
    left = 0

    def get_action(self, percept):
        return to(percept["bearing"])


# %% tags=["wrong", "begin", "compares in place of setting"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    state = "seek"
    left = 0

    def get_action(self, percept):
        if percept["bumper"][0] == 1:
            self.state == "back off"
        return to(percept["bearing"])


# %% tags=["wrong", "endless", "backs off in a loop"]
class AroundTheWall(Controller):
    """Gets around the wall."""

    state = "seek"
    left = 0

    def get_action(self, percept):
        while percept["bumper"][0] == 1:
            action = {"move": [-1, 0, 0, 0]}
        return to(percept["bearing"])


# %% tags=["wrong", "begin", "a big arc"]
def AroundTheWall(percept):
    sine, cosine = percept["bearing"]
    return {"move": [1, max(-1, min(1, 0.6 - sine)), 0, 0]}


# %% tags=["lucky", "an arc that turns while it bumps"]
def AroundTheWall(percept):
    sine, cosine = percept["bearing"]
    if percept["bumper"][0] == 1:
        return {"move": [1, 1, 0, 0]}
    return {"move": [1, max(-1, min(1, 0.4 - sine)), 0, 0]}


# %% tags=["lucky", "an arc to the left"]
def AroundTheWall(percept):
    sine, cosine = percept["bearing"]
    return {"move": [1, max(-1, min(1, -0.6 - sine)), 0, 0]}


# %% tags=["lucky", "turns while it bumps"]
def AroundTheWall(percept):
    sine, cosine = percept["bearing"]
    if percept["bumper"][0] == 1:
        return {"move": [0, 1, 0, 0]}
    return {"move": [1, -0.3 - 0.5 * sine, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def AroundTheWall(percept):
    sine, cosine = percept["bearing"]
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}


# %% tags=["lucky", "by the clock"]
class AroundTheWall(Controller):
    """Gets to the box, although there is a wall in its way."""

    count = 0

    def get_action(self, percept):
        now = self.count % 90
        self.count = self.count + 1
        if now < 45:
            return to(percept["bearing"])
        if now < 51:
            return {"move": [-1, 0, 0, 0]}
        if now < 57:
            return {"move": [0, 1, 0, 0]}
        return {"move": [1, 0, 0, 0]}
