# %% tags=["solution"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -0.2 if left > 0 else 0.2, 0, 0]}  # slowly: the news are late
    return {"move": [1, -0.5 * left, 0, 0]}


# %% tags=["wrong", "fast"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.95:
        return {"move": [0, -0.9 if left > 0 else 0.9, 0, 0]}
    return {"move": [0.5, -left, 0, 0]}
