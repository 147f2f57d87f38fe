# %% tags=["solution"]
class Nearness(Sensor):
    """How near the target is: 1 right at it, 0 at the reach and beyond."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        away = body.distance(view[self.target])
        return max(0.0, 1.0 - away / self.reach)


# %% tags=["wrong", "reversed"]
class Nearness(Sensor):
    """How far the target is."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return min(1.0, body.distance(view[self.target]) / self.reach)


# %% tags=["wrong", "beyond"]
class Nearness(Sensor):
    """Forgets that one can be beyond the reach."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return 1.0 - body.distance(view[self.target]) / self.reach


# %% tags=["wrong", "reach"]
class Nearness(Sensor):
    """Has forgotten its parameter."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return max(0.0, 1.0 - body.distance(view[self.target]) / 8)


# %% tags=["right", "clip"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        share = 1 - body.distance(view[self.target]) / self.reach
        return share if share > 0 else 0.0


# %% tags=["right", "a list"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return [max(0.0, 1.0 - body.distance(view[self.target]) / self.reach)]


# %% tags=["wrong", "target", "the box by name"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return max(0.0, 1.0 - body.distance(view["box"]) / self.reach)


# %% tags=["wrong", "no-base", "no Sensor"]
class Nearness:
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return max(0.0, 1.0 - body.distance(view[self.target]) / self.reach)


# %% tags=["wrong", "no-return", "returns nothing"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        away = body.distance(view[self.target])
        max(0.0, 1.0 - away / self.reach)


# %% tags=["lucky", "a constant"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return 0.5


# %% tags=["lucky", "the reach"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return 1 / self.reach


# %% tags=["lucky", "near or not"]
class Nearness(Sensor):
    """Mine."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return 1.0 if body.distance(view[self.target]) < self.reach else 0.0
