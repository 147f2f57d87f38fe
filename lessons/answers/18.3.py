# %% tags=["solution"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.45 and water > 0.45:
        return {"move": [0, 0, 0, 0]}  # all is well: rest
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "greedy"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "late"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.2 and water > 0.2:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["right", "begins at 0.5"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.5 and water > 0.5:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["right", "begins at 0.48"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.48 and water > 0.48:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["right", "begins at 0.4"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.4 and water > 0.4:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "hundred", "45 for 0.45"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy < 45 and water < 45:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "begin", "rests"]
def live_well(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "late", "at 0.1"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.1 and water > 0.1:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "greedy", "at 0.8"]
def live_well(percept):
    energy, water = percept["inside"]
    if energy > 0.8 and water > 0.8:
        return {"move": [0, 0, 0, 0]}
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["lucky", "food only"]
def live_well(percept):
    return to(percept["to food"])


# %% tags=["lucky", "takes turns"]
count = 0


def live_well(percept):
    global count
    count = count + 1
    if count % 96 < 48:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["lucky", "by chance"]
import random


def live_well(percept):
    return random.choice([to(percept["to food"]), to(percept["to water"]), {"move": [0, 0, 0, 0]}])
