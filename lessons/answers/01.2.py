# %% tags=["solution"]
def turn_for(side):
    if side == "left":
        return -1
    elif side == "right":
        return 1
    else:
        return 0


# %% tags=["right", "three ifs"]
def turn_for(side):
    turn = 0
    if side == "left":
        turn = -1
    if side == "right":
        turn = 1
    return turn


# %% tags=["right", "a dictionary"]
def turn_for(side):
    return {"left": -1, "right": 1, "ahead": 0}[side]


# %% tags=["right", "ahead first"]
def turn_for(side):
    if side == "ahead":
        return 0
    if side != "left":
        return 1
    return -1


# %% tags=["wrong", "mirrored", "the other way round"]
def turn_for(side):
    if side == "left":
        return 1
    elif side == "right":
        return -1
    else:
        return 0


# %% tags=["wrong", "no-return", "prints"]
def turn_for(side):
    if side == "left":
        print(-1)
    elif side == "right":
        print(1)
    else:
        print(0)


# %% tags=["wrong", "no-return", "no answer for ahead"]
def turn_for(side):
    if side == "left":
        return -1
    elif side == "right":
        return 1


# %% tags=["wrong", "spins", "else for the right"]
def turn_for(side):
    if side == "left":
        return -1
    else:
        return 1


# %% tags=["wrong", "one-side", "a capital letter"]
def turn_for(side):
    if side == "Left":
        return -1
    elif side == "right":
        return 1
    else:
        return 0


# %% tags=["wrong", "error", "a word without quotes"]
def turn_for(side):
    if side == left:
        return -1
    return 1


# %% tags=["wrong", "not-a-number", "words"]
def turn_for(side):
    return side


# %% tags=["wrong", "spins", "an or that is always true"]
def turn_for(side):
    if side == "left" or "ahead":
        return -1
    return 1


# %% tags=["wrong", "one-side", "one way round will do"]
def turn_for(side):
    if side == "ahead":
        return 0
    return 1


# %% tags=["wrong", "one-side", "gently to the left"]
def turn_for(side):
    if side == "left":
        return -0.5
    elif side == "right":
        return 1
    else:
        return 0


# %% tags=["lucky", "always left"]
def turn_for(side):
    return -1


# %% tags=["lucky", "by the length of the word"]
def turn_for(side):
    return len(side) - 5


# %% tags=["lucky", "by chance"]
import random


def turn_for(side):
    return random.choice([-1, 0, 1])
