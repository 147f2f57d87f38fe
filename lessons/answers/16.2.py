# %% tags=["solution"]
def fight(percept):
    x, y = percept["position"][0], percept["position"][1]
    forward, left, height = percept["opponent"]
    looks_at_it = forward > 0 and abs(left) < 0.5 * forward
    if math.hypot(x, y) > 0.8 * RING and not looks_at_it:
        forward, left = to_the_middle(percept)  # first away from the edge
    return go_to(forward, left)


# %% tags=["wrong", "edge"]
def fight(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "shy"]
def fight(percept):
    forward, left = to_the_middle(percept)
    return {"move": [0, 0.5, 0, 0]}


# %% tags=["right", "attacks"]
def fight(percept):
    forward, left, height = percept["opponent"]
    return go_to(forward, left)


# %% tags=["right", "attacks, without the helper"]
def fight(percept):
    forward, left, height = percept["opponent"]
    angle = math.atan2(left, forward)
    return {"move": [1 if abs(angle) < 0.6 else 0, max(-1, min(1, -2 * angle)), 0, 0]}


# %% tags=["wrong", "away", "left for right"]
def fight(percept):
    forward, left, height = percept["opponent"]
    return go_to(forward, -left)


# %% tags=["wrong", "shy", "always back to the middle"]
def fight(percept):
    forward, left, height = percept["opponent"]
    if math.hypot(percept["position"][0], percept["position"][1]) > 0.5 * RING:
        forward, left = to_the_middle(percept)
    return go_to(forward, left)


# %% tags=["wrong", "shy", "stays in the middle"]
def fight(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "edge", "backward"]
def fight(percept):
    return {"move": [-1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def fight(percept):
    return {"move": [0.5, 0.5, 0, 0]}


# %% tags=["lucky", "spins"]
def fight(percept):
    return {"move": [0, 1, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def fight(percept):
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}
