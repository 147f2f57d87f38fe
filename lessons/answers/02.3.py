# %% tags=["solution"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2.1:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "look"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance < 2:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "late"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 1:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "blind"]
count = 0


def stop_in_time(percept):
    global count
    count = count + 1
    return {"move": [1 if (count - 1) % 180 < 4 else 0, 0, 0, 0]}


# %% tags=["right", "slows down"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    return {"move": [min(1, 0.5 * (distance - 2)), 0, 0, 0]}


# %% tags=["right", "slows down gently"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    return {"move": [0.3 * (distance - 2), 0, 0, 0]}


# %% tags=["right", "one expression"]
def stop_in_time(percept):
    return {"move": [float(percept["orientation"][1] > 2.1), 0, 0, 0]}


# %% tags=["wrong", "never", "equals 2"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance == 2:
        return {"move": [0, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "endless", "a loop until it is there"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    while distance > 2:
        action = {"move": [1, 0, 0, 0]}
    return action


# %% tags=["wrong", "no-return", "nothing where it has to stop"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2.1:
        return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "early", "stops a metre too early"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 3:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "reversed", "backward while it is far"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2:
        return {"move": [-1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["lucky", "always half a second"]
count = 0


def stop_in_time(percept):
    global count
    count = count + 1
    return {"move": [1 if count < 7 else 0, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def stop_in_time(percept):
    return {"move": [random.choice([0, 1]), 0, 0, 0]}


# %% tags=["lucky", "to and fro"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    return {"move": [1 if distance > 2 else -1, 0, 0, 0]}


# %% tags=["wrong", "spins", "turns on the spot when it is near"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2.1:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 1, 0, 0]}


# %% tags=["wrong", "empty", "rolls on when it is near"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2.1:
        return {"move": [1, 0, 0, 0]}
    return {}


# %% tags=["wrong", "empty", "does nothing"]
def stop_in_time(percept):
    return {}


# %% tags=["wrong", "once", "looks once"]
left = []


def stop_in_time(percept):
    distance = percept["orientation"][1]
    if not left:
        left.append((distance - 2) * 12 / 3)
    left[0] = left[0] - 1
    return {"move": [1 if left[0] >= 0 else 0, 0, 0, 0]}
