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
