# %% tags=["solution"]
def dry_summer(percept):
    energy, water = percept["inside"]
    # what will be short first? Energy falls by 4 a second, water by 6
    food_first = (energy - 0.4) / 0.04 < (water - 0.4) / 0.06
    left, ahead = percept["to food"] if food_first else percept["to water"]
    angle = math.atan2(left, ahead)
    seconds = min((energy - 0.4) / 0.04, (water - 0.4) / 0.06)
    drives = seconds < 1 and abs(angle) < 0.8
    return {"move": [1 if drives else 0, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["right", "looks at what is lower"]
def dry_summer(percept):
    energy, water = percept["inside"]
    left, ahead = percept["to food"] if energy < water else percept["to water"]
    angle = math.atan2(left, ahead)
    drives = min(energy, water) < 0.45 and abs(angle) < 0.7
    return {"move": [1 if drives else 0, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["right", "drives more slowly while it turns"]
def dry_summer(percept):
    energy, water = percept["inside"]
    left, ahead = percept["to food"] if energy < water else percept["to water"]
    turn = max(-1, min(1, -3 * math.atan2(left, ahead)))
    return {"move": [max(0, ahead) if min(energy, water) < 0.45 else 0, turn, 0, 0]}


# %% tags=["right", "with a margin for water"]
def dry_summer(percept):
    energy, water = percept["inside"]
    goal = "to food" if energy + 0.01 < water else "to water"
    left, ahead = percept[goal]
    angle = math.atan2(left, ahead)
    low = energy < 0.44 or water < 0.46
    return {"move": [1 if low and abs(angle) < 0.8 else 0, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["wrong", "begin", "rests for ever"]
def dry_summer(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "rest", "as in 18.3"]
def dry_summer(percept):
    energy, water = percept["inside"]
    if min(energy, water) > 0.45:
        return {"move": [0, 0, 0, 0]}
    return to(percept["to food"] if energy < water else percept["to water"])


# %% tags=["wrong", "early", "always on its way"]
def dry_summer(percept):
    energy, water = percept["inside"]
    return to(percept["to food"] if energy < water else percept["to water"])


# %% tags=["wrong", "late", "looks, and goes too late"]
def dry_summer(percept):
    energy, water = percept["inside"]
    left, ahead = percept["to food"] if energy < water else percept["to water"]
    angle = math.atan2(left, ahead)
    drives = min(energy, water) < 0.4 and abs(angle) < 0.7
    return {"move": [1 if drives else 0, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["wrong", "hundred", "levels up to 100"]
def dry_summer(percept):
    energy, water = percept["inside"]
    if energy > 45 and water > 45:
        return {"move": [0, 0, 0, 0]}
    return to(percept["to food"])


# %% tags=["lucky", "circles"]
def dry_summer(percept):
    return {"move": [0.5, 0.4, 0, 0]}


# %% tags=["lucky", "takes turns"]
count = 0


def dry_summer(percept):
    global count
    count += 1
    return to(percept["to food"] if count % 120 < 60 else percept["to water"])


# %% tags=["lucky", "water only"]
def dry_summer(percept):
    return to(percept["to water"])
