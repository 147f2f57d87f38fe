# %% tags=["solution"]
def go(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "backward"]
def go(percept):
    return {"move": [-1, 0, 0, 0]}


# %% tags=["wrong", "still"]
def go(percept):
    return {"move": [0, 1, 0, 0]}
