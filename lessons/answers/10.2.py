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


# %% tags=["right", "a weighted mean"]
def update(value, reward, best_next, rate, discount):
    return (1 - rate) * value + rate * (reward + discount * best_next)


# %% tags=["right", "step by step"]
def update(value, reward, best_next, rate, discount):
    error = reward + discount * best_next - value
    value += rate * error
    return value


# %% tags=["wrong", "undiscounted", "forgets the discount"]
def update(value, reward, best_next, rate, discount):
    return value + rate * (reward + best_next - value)


# %% tags=["wrong", "minus-value", "forgets the value"]
def update(value, reward, best_next, rate, discount):
    return value + rate * (reward + discount * best_next)


# %% tags=["wrong", "bracket", "a bracket too few"]
def update(value, reward, best_next, rate, discount):
    return value + rate * (reward + discount * best_next) - value


# %% tags=["wrong", "other-side", "the rate on the wrong side"]
def update(value, reward, best_next, rate, discount):
    return rate * value + (1 - rate) * (reward + discount * best_next)


# %% tags=["wrong", "stays", "nothing is learned"]
def update(value, reward, best_next, rate, discount):
    return value


# %% tags=["lucky", "the larger one"]
def update(value, reward, best_next, rate, discount):
    return max(value, best_next)


# %% tags=["lucky", "a constant"]
def update(value, reward, best_next, rate, discount):
    return 0.5


# %% tags=["lucky", "the mean"]
def update(value, reward, best_next, rate, discount):
    return (value + reward) / 2
