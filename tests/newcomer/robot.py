"""A newcomer's blocks: one of each kind, in a file of their own."""

# mypy: disallow-untyped-defs=False

from gymnasium.spaces import Box

from ai4u_edu import Actuator, Controller, RewardFunc, Sensor


class Smell(Sensor):
    """Strength of a body's smell: 1 right at it, 0 far away."""

    source: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return max(0.0, 1.0 - body.distance(view[self.source]) / self.reach)


class Crab(Actuator):
    """Pushes the body to its left (1) or to its right (-1)."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, self.newtons * action[0])


class Cosy(RewardFunc):
    """Pays for each decision that ends near a body."""

    place: str
    near: float = 3.0

    def on_update(self, body, view):
        return 1.0 if body.distance(view[self.place]) < self.near else 0.0


class Slalom(Controller):
    """Drives ahead, and turns to the one side and to the other."""

    period: int = 20

    def on_reset(self, agent, view):
        self.decisions = 0

    def get_action(self, percept):
        self.decisions += 1
        side = 1 if self.decisions % self.period < self.period / 2 else -1
        return {"move": [1.0, 0.8 * side, 0.0, 0.0]}
