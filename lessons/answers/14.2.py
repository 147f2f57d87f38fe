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
