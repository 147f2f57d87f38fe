# %% tags=["solution"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.degrees(math.atan2(sine, cosine))


# %% tags=["wrong", "behind"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.degrees(math.asin(sine))


# %% tags=["wrong", "degrees"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.atan2(sine, cosine)


# %% tags=["wrong", "side"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.degrees(math.acos(cosine))


# %% tags=["right", "cosine with the sine's sign"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    angle = math.degrees(math.acos(max(-1, min(1, cosine))))
    return angle if sine > 0 else -angle


# %% tags=["right", "numpy"]
import numpy as np


def angle_to_box(percept):
    return np.degrees(np.arctan2(*percept["bearing"]))


# %% tags=["right", "an array of one"]
import numpy as np


def angle_to_box(percept):
    return np.degrees(np.arctan2(percept["bearing"][:1], percept["bearing"][1:]))


# %% tags=["wrong", "mirrored", "left and right swapped"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.degrees(math.atan2(-sine, cosine))


# %% tags=["wrong", "swapped", "cosine first"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return math.degrees(math.atan2(cosine, sine))


# %% tags=["wrong", "no-return", "prints"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    print(math.degrees(math.atan2(sine, cosine)))


# %% tags=["lucky", "a constant"]
def angle_to_box(percept):
    return 20


# %% tags=["lucky", "a share of 180"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return 180 * sine


# %% tags=["lucky", "a share of a right angle"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return 90 * (1 - cosine) * (1 if sine > 0 else -1)
