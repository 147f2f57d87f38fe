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


# %% tags=["right", "max"]
def seconds_of_comfort(level, loss):
    return max(0, (level - 40) / loss)


# %% tags=["right", "one expression"]
def seconds_of_comfort(level, loss):
    return (level - 40) / loss if level > 40 else 0.0


# %% tags=["wrong", "whole", "whole seconds"]
def seconds_of_comfort(level, loss):
    return max(0, (level - 40) // loss)


# %% tags=["wrong", "up", "counts"]
def seconds_of_comfort(level, loss):
    seconds = 0
    while level > 40:
        level = level - loss
        seconds = seconds + 1
    return seconds


# %% tags=["wrong", "endless-loop", "counts until it is exactly 40"]
def seconds_of_comfort(level, loss):
    seconds = 0
    while level != 40:
        level = level - loss
        seconds = seconds + 1
    return seconds


# %% tags=["wrong", "product", "times the loss"]
def seconds_of_comfort(level, loss):
    return max(0, (level - 40) * loss)


# %% tags=["wrong", "begin", "the level"]
def seconds_of_comfort(level, loss):
    return level


# %% tags=["lucky", "a constant"]
def seconds_of_comfort(level, loss):
    return 5


# %% tags=["lucky", "a table"]
TABLE = {(60.0, 4.0): 5, (50.0, 3.0): 10 / 3, (30.0, 2.0): 0}


def seconds_of_comfort(level, loss):
    return TABLE.get((level, loss), 10)


# %% tags=["lucky", "half of it"]
def seconds_of_comfort(level, loss):
    return level / 2 / loss
