# %% tags=["solution"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    if left == 0 or ahead == 0 or right == 0:  # turn on the spot, until all is clear
        return {"move": [0, 1, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "dither"]
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
