# %% tags=["solution"]
def update(value, reward, best_next, rate, discount):
    target = reward + discount * best_next  # what this step turned out to be worth
    return value + rate * (target - value)  # a part of the way towards it


# %% tags=["wrong", "jump"]
def update(value, reward, best_next, rate, discount):
    return reward + discount * best_next


# %% tags=["wrong", "future"]
def update(value, reward, best_next, rate, discount):
    return value + rate * (reward - value)
