# %% tags=["solution"]
def worth(rewards, discount):
    # the first reward counts in full, each later one less: 1, discount, discount squared ...
    return sum(reward * discount**n for n, reward in enumerate(rewards))


# %% tags=["wrong", "first"]
def worth(rewards, discount):
    return sum(reward * discount ** (n + 1) for n, reward in enumerate(rewards))


# %% tags=["wrong", "later"]
def worth(rewards, discount):
    return discount * len(rewards) + sum(rewards)
