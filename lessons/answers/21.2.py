# %% tags=["solution"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    turn = right + 0.5 * half_right - 0.5 * half_left - left
    return {"move": [0.7, turn, 0, 0]}


# %% tags=["right", "three cases"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    if left == 1 or half_left == 1:
        return {"move": [0.7, -0.6, 0, 0]}
    if right == 1 or half_right == 1:
        return {"move": [0.7, 0.6, 0, 0]}
    return {"move": [0.8, 0, 0, 0]}


# %% tags=["right", "remembers the side"]
last = 0


def follow(percept):
    global last
    eyes = percept["line"]
    if sum(eyes) > 0:
        last = (eyes[3] + 2 * eyes[4] - eyes[1] - 2 * eyes[0]) / sum(eyes)
    return {"move": [0.7, 0.4 * last, 0, 0]}


# %% tags=["wrong", "mirrored"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    turn = left + 0.5 * half_left - 0.5 * half_right - right
    return {"move": [0.7, turn, 0, 0]}


# %% tags=["wrong", "late", "turns too little"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    turn = right + half_right - half_left - left
    return {"move": [1, 0.02 * turn, 0, 0]}


# %% tags=["wrong", "late", "asks the left eyes alone"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    turn = -0.5 * half_left - left
    return {"move": [0.7, turn, 0, 0]}


# %% tags=["wrong", "begin", "straight on"]
def follow(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "too-slow"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    turn = right + 0.5 * half_right - 0.5 * half_left - left
    return {"move": [0.15, 0.3 * turn, 0, 0]}


# %% tags=["wrong", "stands", "waits for the trail"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    if sum(percept["line"]) == 0:
        return {"move": [0, 0, 0, 0]}
    turn = right + 0.5 * half_right - 0.5 * half_left - left
    return {"move": [0.7, turn, 0, 0]}


# %% tags=["lucky", "a bow to the left"]
def follow(percept):
    return {"move": [1, -0.08, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def follow(percept):
    return {"move": [1, random.uniform(-0.5, 0.5), 0, 0]}


# %% tags=["lucky", "swings by the clock"]
count = 0


def follow(percept):
    global count
    count = count + 1
    return {"move": [0.8, 0.3 * math.sin(count / 10), 0, 0]}
