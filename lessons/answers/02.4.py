# %% tags=["solution"]
def steer(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "mirrored"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "behind"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, -left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)
