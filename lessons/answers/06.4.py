# %% tags=["solution"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0:
        return {"move": [0, 1, 0, 0]}
    if left == 0:  # the edge is beside the robot: it can drive on while it turns away
        return {"move": [1, 1, 0, 0]}
    if right == 0:
        return {"move": [1, -1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["right", "a slight curve to the left"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0 or right == 0:
        return {"move": [0, 1, 0, 0]}
    if left == 0:
        return {"move": [1, 0.5, 0, 0]}
    return {"move": [1, -0.1, 0, 0]}


# %% tags=["right", "a slight curve to the right"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0 or right == 0:
        return {"move": [0, 1, 0, 0]}
    if left == 0:
        return {"move": [1, 0.5, 0, 0]}
    return {"move": [1, 0.1, 0, 0]}


# %% tags=["right", "gently on one side"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0:
        return {"move": [0, 1, 0, 0]}
    if left == 0:
        return {"move": [1, 0.3, 0, 0]}
    if right == 0:
        return {"move": [0.5, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "stops", "the usual one"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0 or ahead == 0 or right == 0:
        return {"move": [0, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "stops", "slows down beside the edge"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0:
        return {"move": [0, 1, 0, 0]}
    if left == 0 or right == 0:
        return {"move": [0.5, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "brake", "drives on in front of the edge"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0:
        return {"move": [1, 1, 0, 0]}
    if right == 0:
        return {"move": [1, -1, 0, 0]}
    if ahead == 0:
        return {"move": [1, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "towards", "turns towards the edge"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0:
        return {"move": [1, -0.3, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "begin", "straight on"]
def quick_stroll(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "no-return", "nothing where it is clear"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    if ahead == 0:
        return {"move": [0, 1, 0, 0]}


# %% tags=["lucky", "a wide circle"]
def quick_stroll(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "a tight circle"]
def quick_stroll(percept):
    return {"move": [1, 1, 0, 0]}


# %% tags=["lucky", "to and fro"]
count = 0


def quick_stroll(percept):
    global count
    count = count + 1
    return {"move": [1 if count % 24 < 12 else -1, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def quick_stroll(percept):
    return {"move": [1, random.uniform(-1, 1), 0, 0]}


# %% tags=["wrong", "dithers", "turns to and fro"]
count = 0


def quick_stroll(percept):
    global count
    count = count + 1
    left, ahead, right = percept["feelers"]
    if ahead == 0:
        return {"move": [0, 1 if count % 2 else -1, 0, 0]}
    return {"move": [1, 0, 0, 0]}
