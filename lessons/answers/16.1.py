# %% tags=["solution"]
def chase(percept):
    best, nearest = None, 1000
    for number in (1, 2, 3):
        place = percept[f"runner {number}"]
        away = math.hypot(place[0], place[1])
        if percept["free"][number - 1] == 1 and away < nearest:
            best, nearest = place, away
    return go_to(best[0], best[1])


# %% tags=["wrong", "caught"]
def chase(percept):
    best, nearest = None, 1000
    for number in (1, 2, 3):
        place = percept[f"runner {number}"]
        away = math.hypot(place[0], place[1])
        if away < nearest:  # runs to where it caught the first one, for good
            best, nearest = place, away
    return go_to(best[0], best[1])


# %% tags=["wrong", "none"]
def chase(percept):
    return {"move": [0, 0.3, 0, 0]}


# %% tags=["right", "min"]
def chase(percept):
    free = [number for number in (1, 2, 3) if percept["free"][number - 1] == 1]
    place = min(
        (percept[f"runner {number}"] for number in free),
        key=lambda place: math.hypot(place[0], place[1]),
    )
    return go_to(place[0], place[1])


# %% tags=["right", "in their order"]
def chase(percept):
    for number in (1, 2, 3):
        if percept["free"][number - 1] == 1:
            forward, left, height = percept[f"runner {number}"]
            return go_to(forward, left)
    return go_to(0, 1)


# %% tags=["wrong", "begin", "the first one only"]
def chase(percept):
    forward, left, height = percept["runner 1"]
    return go_to(forward, left)


# %% tags=["wrong", "none", "stands"]
def chase(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "error", "one number too many"]
def chase(percept):
    return go_to(*percept["runner 1"])


# %% tags=["wrong", "none", "away from the farthest one"]
def chase(percept):
    free = [number for number in (1, 2, 3) if percept["free"][number - 1] == 1]
    place = max(
        (percept[f"runner {number}"] for number in free),
        key=lambda place: math.hypot(place[0], place[1]),
    )
    return go_to(-place[0], -place[1])


# %% tags=["lucky", "straight on"]
def chase(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def chase(percept):
    return {"move": [1, 0.4, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def chase(percept):
    return {"move": [1, random.uniform(-1, 1), 0, 0]}


# %% tags=["lucky", "one after the other, for 5 s each"]
count = 0


def chase(percept):
    global count
    forward, left, height = percept[f"runner {count // 60 % 3 + 1}"]
    count = count + 1
    return go_to(forward, left)


# %% tags=["lucky", "one after the other, for 10 s each"]
count = 0


def chase(percept):
    global count
    forward, left, height = percept[f"runner {count // 120 % 3 + 1}"]
    count = count + 1
    return go_to(forward, left)
