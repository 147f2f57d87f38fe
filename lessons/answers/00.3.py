# %% tags=["solution"]
def curve(percept):
    return {"move": [1, 0.5, 0, 0]}


# %% tags=["wrong", "error"]
def curve(percept):
    return {"move": [forward, 0.5, 0, 0]}


# %% tags=["wrong", "curve"]
def curve(percept):
    return {"move": [0, 0.5, 0, 0]}
