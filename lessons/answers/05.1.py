# %% tags=["solution"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [right_eye, left_eye]}  # crossed: the far wheel drives it towards the light


# %% tags=["wrong", "sides"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye, right_eye]}


# %% tags=["wrong", "straight"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye + right_eye, left_eye + right_eye]}


# %% tags=["right", "stronger"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [2 * right_eye, 2 * left_eye]}


# %% tags=["right", "never quite dark"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.1 + right_eye, 0.1 + left_eye]}


# %% tags=["right", "by comparing"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1, 0.2] if right_eye > left_eye else [0.2, 1]}


# %% tags=["wrong", "begin", "stands"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %% tags=["wrong", "straight", "full speed"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1, 1]}


# %% tags=["wrong", "sides", "brakes crossed"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - right_eye, 1 - left_eye]}


# %% tags=["wrong", "sides", "by comparing, the wrong way"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.2, 1] if right_eye > left_eye else [1, 0.2]}


# %% tags=["wrong", "endless", "a loop until it is bright"]
def attack(percept):
    while percept["left eye"][0] < 0.9:
        action = {"wheels": [1, 1]}
    return action


# %% tags=["lucky", "always a curve"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.8, 0.6]}


# %% tags=["lucky", "by chance"]
import random


def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [random.random(), random.random()]}


# %% tags=["lucky", "one eye"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye, 0.3]}


# %% tags=["wrong", "reverse", "crossed, and with a minus"]
def attack(percept):
    left, right = percept["left eye"][0], percept["right eye"][0]
    return {"wheels": [-right, -left]}
