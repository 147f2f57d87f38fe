# %% tags=["solution"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]  # left, straight on, right
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[0]
    elif left < right:
        turn = turns[2]
    else:
        turn = turns[1]
    return {"move": [0.5, turn, 0, 0]}


# %% tags=["right", "the last of the list"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[0]
    elif left < right:
        turn = turns[-1]
    else:
        turn = turns[1]
    return {"move": [0.5, turn, 0, 0]}


# %% tags=["right", "without the list"]
def to_the_lamp(percept):
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        return {"move": [0.5, -0.5, 0, 0]}
    if left < right:
        return {"move": [0.5, 0.5, 0, 0]}
    return {"move": [0.5, 0, 0, 0]}


# %% tags=["right", "by the difference"]
def to_the_lamp(percept):
    difference = percept["right eye"][0] - percept["left eye"][0]
    return {"move": [0.4, max(-1, min(1, 3 * difference)), 0, 0]}


# %% tags=["wrong", "error", "one spelling is right"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > rihgt:
        turn = turns[0]
    elif left < right:
        turn = turns[3]
    else:
        turn = turns[1]
    return {"move": [turn, 0.5, 0, 0]}


# %% tags=["wrong", "error", "counts from 1"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[1]
    elif left < right:
        turn = turns[3]
    else:
        turn = turns[2]
    return {"move": [0.5, turn, 0, 0]}


# %% tags=["wrong", "last", "all but the last line"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[0]
    elif left < right:
        turn = turns[2]
    else:
        turn = turns[1]
    return {"move": [turn, 0.5, 0, 0]}


# %% tags=["wrong", "one-side", "the wrong place of the list"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[0]
    elif left < right:
        turn = turns[1]
    else:
        turn = turns[1]
    return {"move": [0.5, turn, 0, 0]}


# %% tags=["wrong", "away", "the sides are swapped"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        turn = turns[2]
    elif left < right:
        turn = turns[0]
    else:
        turn = turns[1]
    return {"move": [0.5, turn, 0, 0]}


# %% tags=["wrong", "no-return", "prints the action"]
def to_the_lamp(percept):
    left = percept["left eye"][0]
    right = percept["right eye"][0]
    if left > right:
        print({"move": [0.5, -0.5, 0, 0]})
    else:
        print({"move": [0.5, 0.5, 0, 0]})


# %% tags=["lucky", "straight on"]
def to_the_lamp(percept):
    return {"move": [0.5, 0, 0, 0]}


# %% tags=["lucky", "a circle"]
def to_the_lamp(percept):
    return {"move": [0.5, 0.2, 0, 0]}


# %% tags=["lucky", "one eye"]
def to_the_lamp(percept):
    if percept["left eye"][0] > 0.3:
        return {"move": [0.5, -0.5, 0, 0]}
    return {"move": [0.5, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def to_the_lamp(percept):
    return {"move": [0.5, random.uniform(-1, 1), 0, 0]}
