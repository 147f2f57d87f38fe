# %% tags=["solution"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    side = max(-1, min(1, 4 * left))
    if ahead > 0:
        return {"move": [1, -side, 0, 0]}
    return {"move": [-1, side, 0, 0]}  # its back to the box


# %% tags=["right", "drives only if it points at it"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    speed = 1 if ahead > 0 else -1
    turn = max(-1, min(1, -4 * left * speed))
    return {"move": [speed if abs(ahead) > 0.5 else 0, turn, 0, 0]}


# %% tags=["right", "by the angle"]
import math


def quick_steer(percept):
    left, ahead = percept["bearing"]
    if ahead > 0:
        angle = math.atan2(left, ahead)
        return {"move": [1, max(-1, min(1, -3 * angle)), 0, 0]}
    angle = math.atan2(-left, -ahead)
    return {"move": [-1, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["right", "four cases"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    if abs(left) < 0.2:
        return {"move": [1 if ahead > 0 else -1, 0, 0, 0]}
    turn = -1 if left > 0 else 1
    if ahead > 0:
        return {"move": [1, turn, 0, 0]}
    return {"move": [-1, -turn, 0, 0]}


# %% tags=["wrong", "turns", "the usual one"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "turns", "turns sharply, forward only"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, max(-1, min(1, -4 * left)), 0, 0]}


# %% tags=["wrong", "mirrored", "turns the same way when it drives backward"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1 if ahead > 0 else -1, -left, 0, 0]}


# %% tags=["wrong", "gentle", "turns gently"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    if ahead > 0:
        return {"move": [1, -0.5 * left, 0, 0]}
    return {"move": [-1, 0.5 * left, 0, 0]}


# %% tags=["lucky", "never turns on the spot"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "no-return", "nothing where the box is behind"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    if ahead > 0:
        return {"move": [1, -left, 0, 0]}


# %% tags=["lucky", "straight on"]
def quick_steer(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def quick_steer(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def quick_steer(percept):
    return {"move": [random.choice([-1, 1]), random.uniform(-1, 1), 0, 0]}
