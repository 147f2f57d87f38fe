# %% tags=["solution"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 2.5 * left_eye, 1 - 2.5 * right_eye]}


# %% tags=["wrong", "sides"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 2.5 * right_eye, 1 - 2.5 * left_eye]}


# %% tags=["wrong", "weak"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - left_eye, 1 - right_eye]}


# %% tags=["wrong", "strong"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 6 * left_eye, 1 - 6 * right_eye]}


# %% tags=["right", "brakes 3"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 3 * left_eye, 1 - 3 * right_eye]}


# %% tags=["right", "brakes 3.5"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 3.5 * left_eye, 1 - 3.5 * right_eye]}


# %% tags=["right", "slower"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.5 - 1.3 * left_eye, 0.5 - 1.3 * right_eye]}


# %% tags=["wrong", "weak", "the brake of the text"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 2 * left_eye, 1 - 2 * right_eye]}


# %% tags=["wrong", "begin", "nothing in the dark"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %% tags=["wrong", "weak", "attacks"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [right_eye, left_eye]}


# %% tags=["wrong", "strong", "stands in the light"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 5 * left_eye, 1 - 5 * right_eye]}


# %% tags=["lucky", "always a curve"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.8, 0.6]}


# %% tags=["lucky", "waits where it is"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.01, 0.01]}


# %% tags=["lucky", "by chance"]
import random


def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [random.random(), random.random()]}
