# %% tags=["solution"]
def turn_left(percept):
    return {"move": [0, -1, 0, 0]}


# %% tags=["wrong", "right"]
def turn_left(percept):
    return {"move": [0, 1, 0, 0]}


# %% tags=["wrong", "moved"]
def turn_left(percept):
    return {"move": [1, -1, 0, 0]}
