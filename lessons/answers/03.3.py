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


# %% tags=["right", "the other order"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        FallReward(cause_episode_to_end=True),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ],
)


# %% tags=["right", "names of its own"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(name="hit", target="box", reward=10, cause_episode_to_end=True),
        FallReward(name="oops", cause_episode_to_end=True),
    ],
)


# %% tags=["right", "a fall ends an episode anyway"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True), FallReward()],
)


# %% tags=["wrong", "amount", "a tenth"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
)


# %% tags=["wrong", "fall", "a fall pays"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=1, cause_episode_to_end=True),
    ],
)


# %% tags=["wrong", "rewards", "no rewards"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[],
)


# %% tags=["lucky", "only falls"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[FallReward(cause_episode_to_end=True)],
)


# %% tags=["lucky", "ten for everything"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-10, cause_episode_to_end=True),
    ],
)


# %% tags=["lucky", "eleven and minus one"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=11, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
)


# %% tags=["wrong", "amount", "the touch costs"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[TouchRewardFunc(target="box", reward=-10, cause_episode_to_end=True), FallReward()],
)
