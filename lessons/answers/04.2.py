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


# %% tags=["right", "slowly"]
def search(percept):
    cosine = percept["orientation"][0]
    return {"move": [1 if cosine > 0.9 else 0, 0.3, 0, 0]}


# %% tags=["right", "backward"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine < -0.97:
        return {"move": [-1, 0, 0, 0]}
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["right", "the better it looks, the faster"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine > 0.9:
        return {"move": [cosine, 0.1, 0, 0]}
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["wrong", "stays", "turns for ever"]
def search(percept):
    cosine = percept["orientation"][0]
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["wrong", "turn", "waits for it"]
def search(percept):
    cosine = percept["orientation"][0]
    return {"move": [1 if cosine > 0.97 else 0, 0, 0, 0]}


# %% tags=["wrong", "endless", "a loop until it looks at it"]
def search(percept):
    cosine = percept["orientation"][0]
    while cosine < 0.97:
        action = {"move": [0, 0.5, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "turn", "drives where it is small"]
def search(percept):
    cosine = percept["orientation"][0]
    if cosine < 0.97:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["lucky", "circles"]
def search(percept):
    return {"move": [0.5, 0.3, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def search(percept):
    return {"move": [random.uniform(0, 1), random.uniform(-1, 1), 0, 0]}


# %% tags=["lucky", "straight on"]
def search(percept):
    return {"move": [1, 0, 0, 0]}
