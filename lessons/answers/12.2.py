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
