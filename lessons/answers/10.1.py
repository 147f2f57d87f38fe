# %% tags=["solution"]
def worth(rewards, discount):
    # the first reward counts in full, each later one less: 1, discount, discount squared ...
    return sum(reward * discount**n for n, reward in enumerate(rewards))


# %% tags=["wrong", "first"]
def worth(rewards, discount):
    return sum(reward * discount ** (n + 1) for n, reward in enumerate(rewards))


# %% tags=["wrong", "unknown", "adds the discount"]
def worth(rewards, discount):
    return discount * len(rewards) + sum(rewards)


# %% tags=["right", "from behind"]
def worth(rewards, discount):
    total = 0
    for reward in reversed(rewards):
        total = reward + discount * total
    return total


# %% tags=["right", "a growing factor"]
def worth(rewards, discount):
    total, factor = 0, 1
    for reward in rewards:
        total += factor * reward
        factor *= discount
    return total


# %% tags=["right", "numpy"]
import numpy as np


def worth(rewards, discount):
    return np.dot(rewards, discount ** np.arange(len(rewards))) if rewards else 0


# %% tags=["wrong", "undiscounted", "adds up"]
def worth(rewards, discount):
    return sum(rewards)


# %% tags=["wrong", "linear", "a product for a power"]
def worth(rewards, discount):
    return sum(reward * discount * n for n, reward in enumerate(rewards))


# %% tags=["wrong", "once", "discounts the sum"]
def worth(rewards, discount):
    return discount * sum(rewards)


# %% tags=["wrong", "backward", "the order turned round"]
def worth(rewards, discount):
    total = 0
    for reward in rewards:
        total = reward + discount * total
    return total


# %% tags=["lucky", "the first reward"]
def worth(rewards, discount):
    return rewards[0] if rewards else 0


# %% tags=["lucky", "the mean"]
def worth(rewards, discount):
    return sum(rewards) / max(1, len(rewards))


# %% tags=["lucky", "a constant"]
def worth(rewards, discount):
    return 1.0
