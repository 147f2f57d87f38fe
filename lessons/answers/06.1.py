# %% tags=["solution"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0 or ahead == 0 or right == 0:  # turn on the spot, until all is clear
        return {"move": [0, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["right", "away from the side of the edge"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0 or left == 0:
        return {"move": [0, 1, 0, 0]}
    if right == 0:
        return {"move": [0, -1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "brake"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0:
        return {"move": [1, 1, 0, 0]}
    if right == 0:
        return {"move": [1, -1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "spin"]
def stroll(percept):
    return {"move": [0, 1, 0, 0]}


# %% tags=["wrong", "towards"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if right == 0:
        return {"move": [0.5, 0.5, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["right", "turns left"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0 or ahead == 0 or right == 0:
        return {"move": [0, -1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["right", "all of them"]
def stroll(percept):
    return {"move": [1, 0, 0, 0] if all(percept["feelers"]) else [0, 0.7, 0, 0]}


# %% tags=["right", "slowly forward"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if left + ahead + right < 3:
        return {"move": [0, 1, 0, 0]}
    return {"move": [0.6, 0.02, 0, 0]}


# %% tags=["wrong", "blind", "a circle"]
def stroll(percept):
    return {"move": [0.5, 1, 0, 0]}


# %% tags=["wrong", "blind", "a wide circle"]
def stroll(percept):
    return {"move": [1, 0.6, 0, 0]}


# %% tags=["wrong", "endless", "a loop until it is clear"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    while ahead == 0:
        action = {"move": [0, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "stands"]
def stroll(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["lucky", "a tight circle"]
def stroll(percept):
    return {"move": [0.3, 0.9, 0, 0]}


# %% tags=["lucky", "to and fro"]
count = 0


def stroll(percept):
    global count
    count = count + 1
    return {"move": [1 if count % 24 < 12 else -1, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def stroll(percept):
    return {"move": [random.random(), random.uniform(-1, 1), 0, 0]}
