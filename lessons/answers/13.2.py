# %% tags=["solution"]
def live(percept):
    energy, water = percept["inside"]
    if energy < water:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "thirst"]
def live(percept):
    energy, water = percept["inside"]
    return to(percept["to food"])


# %% tags=["wrong", "reversed"]
def live(percept):
    energy, water = percept["inside"]
    if energy > water:
        return to(percept["to food"])
    return to(percept["to water"])
