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


# %% tags=["right", "by index"]
def live(percept):
    inside = percept["inside"]
    return to(percept["to food" if inside[0] < inside[1] else "to water"])


# %% tags=["right", "with a margin"]
def live(percept):
    energy, water = percept["inside"]
    if energy < water - 0.05:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["right", "the urgent one, else what is ahead"]
def live(percept):
    energy, water = percept["inside"]
    if energy < 0.4 and energy < water:
        return to(percept["to food"])
    if water < 0.4:
        return to(percept["to water"])
    if percept["to food"][1] > percept["to water"][1]:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "hundred", "40 for 0.4"]
def live(percept):
    energy, water = percept["inside"]
    if energy < 40:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "no-return", "nothing where both are equal"]
def live(percept):
    energy, water = percept["inside"]
    if energy < water - 0.2:
        return to(percept["to food"])
    if water < energy - 0.2:
        return to(percept["to water"])


# %% tags=["wrong", "thirst", "water only"]
def live(percept):
    return to(percept["to water"])


# %% tags=["lucky", "takes turns"]
count = 0


def live(percept):
    global count
    count = count + 1
    if count % 96 < 48:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["lucky", "whatever is more ahead"]
def live(percept):
    if percept["to food"][1] > percept["to water"][1]:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["lucky", "by chance"]
import random


def live(percept):
    return random.choice([to(percept["to food"]), to(percept["to water"])])


# %% tags=["wrong", "thirst", "food first, always"]
def live(percept):
    energy, water = percept["inside"]
    if energy < 0.9:
        return to(percept["to food"])
    return to(percept["to water"])


# %% tags=["wrong", "thirst", "water first, always"]
def live(percept):
    energy, water = percept["inside"]
    if water < 0.9:
        return to(percept["to water"])
    return to(percept["to food"])
