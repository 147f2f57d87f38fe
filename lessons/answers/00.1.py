# %% tags=["solution"]
def go(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "backward"]
def go(percept):
    return {"move": [-1, 0, 0, 0]}


# %% tags=["wrong", "still"]
def go(percept):
    return {"move": [0, 1, 0, 0]}


# %% tags=["right", "half speed"]
def go(percept):
    return {"move": [0.5, 0, 0, 0]}


# %% tags=["right", "a tuple"]
def go(percept):
    return {"move": (1.0, 0.0, 0.0, 0.0)}


# %% tags=["right", "slowly"]
def go(percept):
    return {"move": [0.1, 0, 0, 0]}


# %% tags=["right", "an array"]
import numpy as np


def go(percept):
    return {"move": np.array([1, 0, 0, 0])}


# %% tags=["wrong", "circle", "turns as well"]
def go(percept):
    return {"move": [0.5, 1, 0, 0]}


# %% tags=["wrong", "still", "takes the third number"]
def go(percept):
    return {"move": [0, 0, 1, 0]}


# %% tags=["wrong", "no-return", "prints in place of returning"]
def go(percept):
    print({"move": [1, 0, 0, 0]})


# %% tags=["wrong", "endless", "drives in a loop"]
def go(percept):
    while True:
        action = {"move": [1, 0, 0, 0]}
    return action


# %% tags=["wrong", "action", "another name of the actuator"]
def go(percept):
    return {"drive": [1, 0, 0, 0]}


# %% tags=["lucky", "forward where the box is ahead"]
def go(percept):
    return {"move": [percept["orientation"][0], 0, 0, 0]}


# %% tags=["lucky", "to and fro"]
count = 0


def go(percept):
    global count
    count = count + 1
    return {"move": [1 if count % 4 < 2 else -1, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def go(percept):
    return {"move": [random.choice([-1, 1]), 0, 0, 0]}
