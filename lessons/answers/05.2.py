# %% tags=["solution"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


class Patrol(Controller):
    """Runs between the posts."""

    goal = "red"

    def get_action(self, percept):
        if percept["at red"][0] == 1:
            self.goal = "blue"
        if percept["at blue"][0] == 1:
            self.goal = "red"
        return to(percept["to " + self.goal])


# %% tags=["wrong", "one"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


class Patrol(Controller):
    """Forgets where it wanted to go."""

    def get_action(self, percept):
        goal = "red"
        if percept["at red"][0] == 1:
            goal = "blue"
        return to(percept["to " + goal])


# %% tags=["wrong", "back"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


class Patrol(Controller):
    """Never turns back."""

    goal = "red"

    def get_action(self, percept):
        if percept["at red"][0] == 1:
            self.goal = "blue"
        return to(percept["to " + self.goal])
