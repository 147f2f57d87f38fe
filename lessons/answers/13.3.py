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
