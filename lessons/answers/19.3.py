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


# %% tags=["right", "named"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        push = self.newtons * float(action[0])
        body.apply_force(forward=0.0, left=push)


# %% tags=["right", "unpacked"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        (push,) = action
        body.apply_force(0, push * self.newtons)


# %% tags=["wrong", "strength", "the sign alone"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, self.newtons if action[0] > 0 else -self.newtons)


# %% tags=["wrong", "error", "a list times a number"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, self.newtons * action)


# %% tags=["wrong", "begin", "nothing"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        pass


# %% tags=["wrong", "no-base", "no Actuator"]
class Crab:
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        pass


# %% tags=["wrong", "speed", "sets a speed"]
import math


class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        speed = self.newtons * action[0] / 10
        body.set_velocity(-math.sin(body.heading) * speed, math.cos(body.heading) * speed)


# %% tags=["lucky", "a constant push"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.apply_force(0.0, 20.0)


# %% tags=["lucky", "turns"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.set_angular_velocity(action[0])


# %% tags=["lucky", "jumps"]
class Crab(Actuator):
    """Mine."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        body.jump(1)
