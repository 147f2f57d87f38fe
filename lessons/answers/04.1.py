# %% tags=["solution"]
def twin(x, y):
    return (x, -y)  # as in a mirror that lies along the robot's nose


# %% tags=["wrong", "behind"]
def twin(x, y):
    return (-x, y)


# %% tags=["wrong", "far"]
def twin(x, y):
    return (2 * x, -2 * y)


# %% tags=["right", "by the angle"]
def twin(x, y):
    away, angle = math.hypot(x, y), math.atan2(y, x)
    return [away * math.cos(-angle), away * math.sin(-angle)]


# %% tags=["right", "an array"]
import numpy as np


def twin(x, y):
    return np.array([x, -y])


# %% tags=["wrong", "other", "the same place"]
def twin(x, y):
    return (x, y)


# %% tags=["wrong", "behind", "behind it"]
def twin(x, y):
    return (-x, -y)


# %% tags=["wrong", "behind", "swapped"]
def twin(x, y):
    return (y, x)


# %% tags=["wrong", "far", "nearer"]
def twin(x, y):
    return (x, -y / 2)


# %% tags=["lucky", "a table"]
TABLE = {(3.0, 1.0): (3, -1), (-3.0, 2.5): (-3, -2.5)}


def twin(x, y):
    return TABLE.get((x, y), (x, -abs(y)))


# %% tags=["lucky", "always on the right"]
def twin(x, y):
    return (x, -abs(y))


# %% tags=["lucky", "a constant"]
def twin(x, y):
    return (3, -1)
