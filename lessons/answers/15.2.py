# %% tags=["solution"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -0.2 if left > 0 else 0.2, 0, 0]}  # slowly: the news is late
    return {"move": [1, -0.5 * left, 0, 0]}


# %% tags=["wrong", "fast"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.95:
        return {"move": [0, -0.9 if left > 0 else 0.9, 0, 0]}
    return {"move": [0.5, -left, 0, 0]}


# %% tags=["right", "a little of everything"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.95:
        return {"move": [0, -0.15 if left > 0 else 0.15, 0, 0]}
    return {"move": [0.7, -0.3 * left, 0, 0]}


# %% tags=["right", "always a bit"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -0.25 if left > 0 else 0.25, 0, 0]}
    return {"move": [0.6 * ahead**4, -0.25 * left, 0, 0]}


# %% tags=["wrong", "fast", "turns at full speed"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -5 * left, 0, 0]}


# %% tags=["wrong", "away", "turns away"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, 0.2 if left > 0 else -0.2, 0, 0]}
    return {"move": [0.5, 0.5 * left, 0, 0]}


# %% tags=["wrong", "still", "never drives"]
def careful(percept):
    left, ahead = percept["bearing"]
    return {"move": [0, -0.2 * left, 0, 0]}


# %% tags=["wrong", "blind", "straight on"]
def careful(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def careful(percept):
    return {"move": [0.3, 0.2, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def careful(percept):
    return {"move": [random.uniform(0, 1), random.uniform(-1, 1), 0, 0]}


# %% tags=["lucky", "waits"]
def careful(percept):
    return {"move": [0, 0, 0, 0]}
