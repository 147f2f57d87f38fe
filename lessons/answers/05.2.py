# %% tags=["solution"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye, right_eye]}  # the wheel on the bright side turns it away


# %% tags=["wrong", "sides"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [right_eye, left_eye]}


# %% tags=["wrong", "rest"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.5 + left_eye, 0.5 + right_eye]}


# %% tags=["right", "stronger"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1.5 * left_eye, 1.5 * right_eye]}


# %% tags=["right", "squares"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye**0.5, right_eye**0.5]}


# %% tags=["wrong", "backward", "backs away"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [-left_eye, -right_eye]}


# %% tags=["wrong", "backward", "backs away, crossed"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [-right_eye, -left_eye]}


# %% tags=["wrong", "begin", "stands"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %% tags=["wrong", "straight", "both eyes on both wheels"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye + right_eye, left_eye + right_eye]}


# %% tags=["wrong", "rest", "always a bit"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.2 + left_eye, 0.2 + right_eye]}


# %% tags=["lucky", "turns once"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.3, -0.3] if left_eye + right_eye > 0.01 else [0, 0]}


# %% tags=["lucky", "always a curve"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.3, 0.1]}


# %% tags=["lucky", "by chance"]
import random


def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [random.random(), random.random()]}
