# %% tags=["solution"]
def decisions_for(distance, speed):
    seconds = distance / speed
    return seconds * 12


# %% tags=["wrong", "time"]
def decisions_for(distance, speed):
    return distance / speed


# %% tags=["wrong", "speed"]
def decisions_for(distance, speed):
    return distance * 4
