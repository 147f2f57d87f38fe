# %% tags=["solution"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-20, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.05, min_dist=5),
    ]


# %% tags=["wrong", "jump"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.1, min_dist=5),
    ]


# %% tags=["wrong", "time"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-20, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0, min_dist=5),
    ]


# %% tags=["right", "dear falls"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-100, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.02, min_dist=5),
    ]


# %% tags=["right", "a large touch"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=50, cause_episode_to_end=True),
        FallReward(success_reward=-30, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.1, min_dist=5),
    ]


# %% tags=["wrong", "pays", "time pays"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-20, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0.05, min_dist=5),
    ]


# %% tags=["wrong", "dear", "time is too dear"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-400, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-1, min_dist=5),
    ]


# %% tags=["wrong", "jump", "a fall costs half of the time"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-3, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.05, min_dist=5),
    ]


# %% tags=["wrong", "time", "only falls cost"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-50, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0, min_dist=5),
    ]


# %% tags=["lucky", "nothing costs"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=0, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0, min_dist=5),
    ]


# %% tags=["lucky", "no touch"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=0, cause_episode_to_end=True),
        FallReward(success_reward=-20, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-0.05, min_dist=5),
    ]


# %% tags=["lucky", "everything 1"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True),
        FallReward(success_reward=1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=1, min_dist=5),
    ]
