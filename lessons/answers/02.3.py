# %% tags=["solution"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
)

# %% tags=["wrong", "end"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[TouchRewardFunc(target="box", reward=10), FallReward()],
)

# %% tags=["wrong", "amount"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[TouchRewardFunc(target="box", cause_episode_to_end=True)],
)

# %% tags=["wrong", "fall"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)],
)
