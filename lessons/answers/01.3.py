# %% tags=["solution"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 2.1:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "look"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance < 2:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "late"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    if distance > 1:
        return {"move": [1, 0, 0, 0]}
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "blind"]
count = 0


def stop_in_time(percept):
    global count
    count = count + 1
    return {"move": [1 if count % 81 < 4 else 0, 0, 0, 0]}
