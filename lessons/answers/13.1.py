# %% tags=["solution"]
def seconds_of_comfort(level, loss):
    if level < 40:
        return 0
    return (level - 40) / loss


# %% tags=["wrong", "empty"]
def seconds_of_comfort(level, loss):
    return level / loss


# %% tags=["wrong", "below"]
def seconds_of_comfort(level, loss):
    return (level - 40) / loss
