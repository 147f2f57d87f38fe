# %% tags=["solution"]
def epsilon(walk, walks):
    return max(0, 1 - walk / (0.75 * walks))  # from 1 to 0, at three quarters of the walks


# %% tags=["right", "first try, then use"]
def epsilon(walk, walks):
    return 1 if walk < walks // 2 else 0


# %% tags=["right", "falls by a factor"]
def epsilon(walk, walks):
    return 0.98**walk


# %% tags=["right", "two stages"]
def epsilon(walk, walks):
    if walk < 60:
        return 0.9
    return 0.3 if walk < 150 else 0.01


# %% tags=["right", "a square"]
def epsilon(walk, walks):
    return (1 - walk / walks) ** 2


# %% tags=["wrong", "none", "never"]
def epsilon(walk, walks):
    return 0


# %% tags=["wrong", "always", "always"]
def epsilon(walk, walks):
    return 1


# %% tags=["wrong", "always", "always a little"]
def epsilon(walk, walks):
    return 0.1


# %% tags=["wrong", "short", "ten walks only"]
def epsilon(walk, walks):
    return 1 if walk < 10 else 0


# %% tags=["wrong", "short", "one over n"]
def epsilon(walk, walks):
    return 1 / (walk + 1)


# %% tags=["wrong", "reversed", "more and more"]
def epsilon(walk, walks):
    return walk / walks


# %% tags=["wrong", "percent", "in percent"]
def epsilon(walk, walks):
    return 100 - 100 * walk / walks


# %% tags=["wrong", "no-return", "prints"]
def epsilon(walk, walks):
    print(1 - walk / walks)


# %% tags=["lucky", "a coin"]
def epsilon(walk, walks):
    return 0.5


# %% tags=["lucky", "by chance"]
import random


def epsilon(walk, walks):
    return random.random()


# %% tags=["lucky", "every third walk"]
def epsilon(walk, walks):
    return 1 if walk % 3 == 0 else 0
