# %% tags=["solution"]
def my_rewards():
    return [
        ProgressReward(target="box", reward=1),  # a robot that goes away again pays it back
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


# %% tags=["right", "the other order"]
def my_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        ProgressReward(target="box", reward=1),
    ]


# %% tags=["right", "a larger trail"]
def my_rewards():
    return [
        ProgressReward(target="box", reward=3),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %% tags=["right", "time costs too"]
def my_rewards():
    return [
        ProgressReward(target="box", reward=2),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.01, min_dist=5),
    ]


# %% tags=["wrong", "linger", "near pays more"]
def my_rewards():
    return [
        DistanceToTargetRewardFunc(target="box", max_reward=1),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %% tags=["wrong", "patience", "near pays a little"]
def my_rewards():
    return [
        DistanceToTargetRewardFunc(target="box", max_reward=0.05),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %% tags=["wrong", "linger", "pays for steps towards it"]
def my_rewards():
    return [Approach()]


# %% tags=["wrong", "list", "no list"]
def my_rewards():
    return TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)


# %% tags=["wrong", "no-return", "returns nothing"]
def my_rewards():
    rewards = [TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)]


# %% tags=["lucky", "nothing"]
def my_rewards():
    return []


# %% tags=["right", "only the trail"]
def my_rewards():
    return [ProgressReward(target="box", reward=1)]


# %% tags=["lucky", "a huge touch"]
def my_rewards():
    return [TouchRewardFunc(target="box", reward=1000, cause_episode_to_end=True)]


# %% tags=["lucky", "pays for every decision"]
def my_rewards():
    return [RestlessnessRewardFunc(reward=1, min_dist=5)]
