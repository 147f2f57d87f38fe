# %% tags=["solution"]
class Crab(Actuator):
    """Pushes the body sideways."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, self.newtons * action[0])


# %% tags=["wrong", "forward"]
class Crab(Actuator):
    """Pushes forward, like everybody."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(self.newtons * action[0], 0.0)


# %% tags=["wrong", "right"]
class Crab(Actuator):
    """Left and right are swapped."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, -self.newtons * action[0])


# %% tags=["wrong", "world"]
class Crab(Actuator):
    """Walks up on the screen, wherever it looks."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.set_velocity(0.0, self.newtons / 10 * action[0])
