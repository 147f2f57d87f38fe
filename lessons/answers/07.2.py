# %% tags=["solution"]
def my_rewards():
    return [
        ProgressReward(target="box", reward=1),  # who goes away again pays it back
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %% tags=["wrong", "linger"]
def my_rewards():
    return [
        DistanceToTargetRewardFunc(target="box", max_reward=0.5),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %% tags=["wrong", "trail"]
def my_rewards():
    return [TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)]
