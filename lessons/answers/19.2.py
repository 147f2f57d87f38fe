# %% tags=["solution"]
class Calm(RewardFunc):
    """A cost for turning fast."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -self.cost if abs(body.angular_velocity) > self.limit else 0.0


# %% tags=["wrong", "side"]
class Calm(RewardFunc):
    """Looks to one side only."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -self.cost if body.angular_velocity > self.limit else 0.0


# %% tags=["wrong", "sign"]
class Calm(RewardFunc):
    """Pays for what it should punish."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return self.cost if abs(body.angular_velocity) > self.limit else 0.0


# %% tags=["right", "if and return"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        if abs(body.angular_velocity) > self.limit:
            return -self.cost
        return 0.0


# %% tags=["right", "both sides"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        turns = body.angular_velocity
        if turns > self.limit or turns < -self.limit:
            return -self.cost
        return 0


# %% tags=["wrong", "limit", "a fixed limit"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -self.cost if abs(body.angular_velocity) > 1 else 0.0


# %% tags=["wrong", "always", "costs always"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -self.cost


# %% tags=["wrong", "no-return", "nothing else"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        if abs(body.angular_velocity) > self.limit:
            return -self.cost


# %% tags=["wrong", "no-base", "no RewardFunc"]
class Calm:
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return 0.0


# %% tags=["lucky", "nothing"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return 0.0


# %% tags=["lucky", "a fixed cost"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -0.1 if abs(body.angular_velocity) > self.limit else 0.0


# %% tags=["lucky", "what it turns"]
class Calm(RewardFunc):
    """Mine."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return -abs(body.angular_velocity)
