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
