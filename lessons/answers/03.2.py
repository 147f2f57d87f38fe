# %% tags=["solution"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine > 0.97:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["wrong", "narrow"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine > 0.9999:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 1, 0, 0]}


# %% tags=["wrong", "wide"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine > 0:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 1, 0, 0]}
