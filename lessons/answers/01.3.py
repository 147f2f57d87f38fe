# %% tags=["solution"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.7:
        return {"move": [0, 0, 0, 0]}
    elif brightness > 0.2:
        return {"move": [0.4, 0, 0, 0]}
    else:
        return {"move": [1, 0, 0, 0]}


# %% tags=["right", "dark first"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness <= 0.2:
        speed = 1
    elif brightness <= 0.7:
        speed = 0.4
    else:
        speed = 0
    return {"move": [speed, 0, 0, 0]}


# %% tags=["right", "both ends"]
def moth(percept):
    brightness = percept["light"][0]
    speed = 1
    if 0.2 < brightness <= 0.7:
        speed = 0.4
    if brightness > 0.7:
        speed = 0
    return {"move": [speed, 0, 0, 0]}


# %% tags=["right", "one in another"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.2:
        if brightness > 0.7:
            return {"move": [0, 0, 0, 0]}
        return {"move": [0.4, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "order", "the wider case first"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.2:
        return {"move": [0.4, 0, 0, 0]}
    elif brightness > 0.7:
        return {"move": [0, 0, 0, 0]}
    else:
        return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "overwritten", "the second if overwrites"]
def moth(percept):
    brightness = percept["light"][0]
    speed = 0
    if brightness < 0.2:
        speed = 1
    if brightness < 0.7:
        speed = 0.4
    return {"move": [speed, 0, 0, 0]}


# %% tags=["wrong", "reversed", "fast in the light"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness < 0.2:
        return {"move": [0, 0, 0, 0]}
    elif brightness < 0.7:
        return {"move": [0.4, 0, 0, 0]}
    else:
        return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "number", "another speed"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.7:
        return {"move": [0, 0, 0, 0]}
    elif brightness > 0.2:
        return {"move": [0.5, 0, 0, 0]}
    else:
        return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "no-return", "nothing in the dark"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.7:
        return {"move": [0, 0, 0, 0]}
    elif brightness > 0.2:
        return {"move": [0.4, 0, 0, 0]}


# %% tags=["wrong", "endless", "a loop while it is dark"]
def moth(percept):
    action = {"move": [0, 0, 0, 0]}
    while percept["light"][0] < 0.7:
        action = {"move": [1, 0, 0, 0]}
    return action


# %% tags=["wrong", "error", "another name of the sensor"]
def moth(percept):
    if percept["brightness"][0] > 0.7:
        return {"move": [0, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "always slow"]
def moth(percept):
    return {"move": [0.4, 0, 0, 0]}


# %% tags=["lucky", "counts its decisions"]
count = 0


def moth(percept):
    global count
    count = count + 1
    if count < 12:
        return {"move": [1, 0, 0, 0]}
    if count < 60:
        return {"move": [0.4, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["lucky", "the darker the faster"]
def moth(percept):
    return {"move": [1 - percept["light"][0], 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def moth(percept):
    return {"move": [random.choice([0, 0.4, 1]), 0, 0, 0]}


# %% tags=["wrong", "number", "7 for 0.7"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 7:
        return {"move": [0, 0, 0, 0]}
    elif brightness > 0.2:
        return {"move": [0.4, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "number", "a gap between two cases"]
def moth(percept):
    brightness = percept["light"][0]
    if brightness > 0.7:
        return {"move": [0, 0, 0, 0]}
    elif 0.3 < brightness < 0.7:
        return {"move": [0.4, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}
