# %% tags=["solution"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.3:
            self.state = "charge"
        elif self.state == "charge" and battery > 0.9:
            self.state = "work"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["right", "charges earlier"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.4:
            self.state = "charge"
        elif self.state == "charge" and battery > 0.95:
            self.state = "work"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["right", "states as true and false"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    is_charging = False

    def get_action(self, percept):
        if percept["battery"][0] < 0.35:
            self.is_charging = True
        if percept["battery"][0] > 0.85:
            self.is_charging = False
        return to(percept["to station"] if self.is_charging else percept["to site"])


# %% tags=["right", "the state is the place"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    def __init__(self):
        self.place = "to site"

    def get_action(self, percept):
        (battery,) = percept["battery"]
        if battery > 0.9:
            self.place = "to site"
        elif battery < 0.3:
            self.place = "to station"
        return to(percept[self.place])


# %% tags=["wrong", "begin", "never charges"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        return to(percept["to site"])


# %% tags=["wrong", "between", "a rule with one number"]
def Worker(percept):
    if percept["battery"][0] < 0.4:
        return to(percept["to station"])
    return to(percept["to site"])


# %% tags=["wrong", "between", "the two numbers are nearly the same"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.4:
            self.state = "charge"
        elif self.state == "charge" and battery > 0.45:
            self.state = "work"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["wrong", "late", "goes at the last moment"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.1:
            self.state = "charge"
        elif self.state == "charge" and battery > 0.9:
            self.state = "work"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["wrong", "stays", "waits for more than full"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.3:
            self.state = "charge"
        elif self.state == "charge" and battery > 1:
            self.state = "work"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["wrong", "begin", "compares in place of setting"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if self.state == "work" and battery < 0.3:
            self.state == "charge"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["wrong", "stays", "no way back"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        if percept["battery"][0] < 0.3:
            self.state = "charge"
        if self.state == "charge":
            return to(percept["to station"])
        return to(percept["to site"])


# %% tags=["wrong", "endless", "charges in a loop"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    def get_action(self, percept):
        while percept["battery"][0] < 0.9:
            action = to(percept["to station"])
        return to(percept["to site"])


# %% tags=["lucky", "by the clock"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        return to(percept["to site" if self.count % 300 < 160 else "to station"])


# %% tags=["lucky", "stays at the station"]
def Worker(percept):
    return to(percept["to station"])


# %% tags=["lucky", "by chance"]
import random


def Worker(percept):
    return to(percept[random.choice(["to site", "to station"])])


# %% tags=["right", "its heading is its memory"]
def Worker(percept):
    battery = percept["battery"][0]
    if battery < 0.3:
        return to(percept["to station"])
    if battery > 0.9:
        return to(percept["to site"])
    return to(max(percept["to station"], percept["to site"], key=lambda bearing: bearing[1]))


# %% tags=["wrong", "percent", "30 for 0.3"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        if battery < 30:
            self.state = "charge"
        elif battery > 90:
            self.state = "work"
        return to(percept["to station" if self.state == "charge" else "to site"])


# %% tags=["lucky", "half of the time at the station"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        return to(percept["to station" if self.count % 300 < 150 else "to site"])


# %% tags=["lucky", "more than half of the time at the station"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        return to(percept["to station" if self.count % 240 < 130 else "to site"])
