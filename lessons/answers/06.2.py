# %% tags=["solution"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0  # decisions for which it has stood still

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited <= 25:
                return {"move": [0, 0, 0, 0]}
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["right", "values from __init__"]
class Patrol(Controller):
    """Guards the posts."""

    def __init__(self):
        self.goal = "red"
        self.waited = 0

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited <= 30:
                return {"move": [0, 0, 0, 0]}
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["right", "four states"]
class Patrol(Controller):
    """Guards the posts."""

    state = "to red"
    left = 0

    def get_action(self, percept):
        if self.state == "to red" and percept["at red"][0] == 1:
            self.state, self.left = "at red", 26
        elif self.state == "to blue" and percept["at blue"][0] == 1:
            self.state, self.left = "at blue", 26
        elif self.state == "at red" and self.left == 0:
            self.state = "to blue"
        elif self.state == "at blue" and self.left == 0:
            self.state = "to red"
        if self.state.startswith("at"):
            self.left = self.left - 1
            return {"move": [0, 0, 0, 0]}
        return to(percept[self.state])


# %% tags=["right", "a function with a global"]
memory = {"goal": "red", "waited": 0}


def Patrol(percept):
    if percept["at " + memory["goal"]][0] == 1:
        memory["waited"] += 1
        if memory["waited"] < 28:
            return {"move": [0, 0, 0, 0]}
        memory["goal"], memory["waited"] = ("blue" if memory["goal"] == "red" else "red"), 0
    return to(percept["to " + memory["goal"]])


# %% tags=["wrong", "forgets", "the goal is not kept"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        goal = "red"
        if percept["at red"][0] == 1:
            goal = "blue"
        return to(percept["to " + goal])


# %% tags=["wrong", "short", "does not rest"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at red"][0] == 1:
            self.goal = "blue"
        if percept["at blue"][0] == 1:
            self.goal = "red"
        return to(percept["to " + self.goal])


# %% tags=["wrong", "back", "never turns back"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited <= 30:
                return {"move": [0, 0, 0, 0]}
            self.goal = "blue"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["wrong", "begin", "compares in place of setting"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited <= 30:
                return {"move": [0, 0, 0, 0]}
            self.goal == "blue"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["wrong", "begin", "a rule that stands still at a post"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at red"][0] == 1 or percept["at blue"][0] == 1:
            return {"move": [0, 0, 0, 0]}
        return to(percept["to red"])


# %% tags=["wrong", "no-base", "no Controller"]
class Patrol:
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited <= 30:
                return {"move": [0, 0, 0, 0]}
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["wrong", "endless", "waits in a loop"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        while percept["at red"][0] == 1:
            self.waited = self.waited + 1
        return to(percept["to red"])


# %% tags=["lucky", "whatever is more ahead"]
def Patrol(percept):
    if percept["at red"][0] == 1:
        return to(percept["to blue"])
    if percept["at blue"][0] == 1:
        return to(percept["to red"])
    return to(max(percept["to red"], percept["to blue"], key=lambda bearing: bearing[1]))


# %% tags=["lucky", "turns slowly at a post until it looks at the other"]
def Patrol(percept):
    for here, there in (("red", "blue"), ("blue", "red")):
        if percept["at " + here][0] == 1 and percept["to " + there][1] < 0.9:
            return {"move": [0, 0.2, 0, 0]}
    return to(max(percept["to red"], percept["to blue"], key=lambda bearing: bearing[1]))


# %% tags=["lucky", "by chance"]
import random


def Patrol(percept):
    return to(percept[random.choice(["to red", "to blue"])])


# %% tags=["lucky", "turns by a hair at a post, and reads the bearing as a clock"]
def towards(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -4 * (left + 0.036), 0, 0]}  # a little beside it: the hand of the clock


def Patrol(percept):
    for here, there in (("red", "blue"), ("blue", "red")):
        left, ahead = percept["to " + here]
        if percept["at " + here][0] == 1:
            if ahead > 0 and -0.1 < left < 0:
                return {"move": [0, 0.0035, 0, 0]}
            if percept["to " + there][1] < 0.5:
                return {"move": [0, 1, 0, 0]}
            return towards(percept["to " + there])
    return towards(max(percept["to red"], percept["to blue"], key=lambda bearing: bearing[1]))


# %% tags=["wrong", "pushes", "changes the post by the clock"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        self.waited = self.waited + 1
        if self.waited == 110:
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        return to(percept["to " + self.goal])


# %% tags=["wrong", "pushes", "rests by the clock"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        self.waited = self.waited + 1
        if self.waited == 110:
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        if self.waited > 84:
            return {"move": [0, 0, 0, 0]}
        return to(percept["to " + self.goal])


# %% tags=["wrong", "empty", "does nothing at all"]
def Patrol(percept):
    return {}


# %% tags=["right", "an empty action for a rest"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0

    def get_action(self, percept):
        if percept["at " + self.goal][0] == 1:
            self.waited = self.waited + 1
            if self.waited == 1:
                return {"move": [0, 0, 0, 0]}
            if self.waited <= 30:
                return {}
            self.goal = "blue" if self.goal == "red" else "red"
            self.waited = 0
        return to(percept["to " + self.goal])
