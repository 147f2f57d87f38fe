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


def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


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


def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


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


def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}
