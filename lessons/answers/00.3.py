# %% tags=["solution"]
def curve(percept):
    return {"move": [1, 0.5, 0, 0]}


# %% tags=["wrong", "error"]
def curve(percept):
    return {"move": [forward, 0.5, 0, 0]}


# %% tags=["wrong", "curve"]
def curve(percept):
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["right", "wide"]
def curve(percept):
    return {"move": [1, 0.2, 0, 0]}


# %% tags=["right", "tight"]
def curve(percept):
    return {"move": [0.5, 1, 0, 0]}


# %% tags=["wrong", "backward", "a curve backward"]
def curve(percept):
    return {"move": [-1, 0.5, 0, 0]}


# %% tags=["wrong", "curve", "straight on"]
def curve(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "curve", "to the left"]
def curve(percept):
    return {"move": [1, -0.5, 0, 0]}


# %% tags=["wrong", "action", "the name is still wrong"]
def curve(percept):
    return {"mvoe": [1, 0.5, 0, 0]}


# %% tags=["lucky", "a curve where the box is ahead"]
def curve(percept):
    return {"move": [1, percept["orientation"][0], 0, 0]}


# %% tags=["lucky", "left and right in turn"]
count = 0


def curve(percept):
    global count
    count = count + 1
    return {"move": [1, 1 if count % 2 else -1, 0, 0]}


# %% tags=["lucky", "turns on the spot by chance"]
import random


def curve(percept):
    return {"move": [random.choice([0, -1]), 0.5, 0, 0]}
