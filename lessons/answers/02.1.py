# %% tags=["solution"]
def decisions_for(distance, speed):
    seconds = distance / speed
    return seconds * 12


# %% tags=["wrong", "speed"]
def decisions_for(distance, speed):
    return distance * 4


# %% tags=["right", "metres a decision"]
def decisions_for(distance, speed):
    step = speed / 12
    return distance / step


# %% tags=["right", "rounded up"]
def decisions_for(distance, speed):
    return math.ceil(12 * distance / speed)


# %% tags=["right", "counted"]
def decisions_for(distance, speed):
    count = 0
    while (count + 1) * speed / 12 <= distance:
        count = count + 1
    return count


# %% tags=["wrong", "ticks", "ticks for decisions"]
def decisions_for(distance, speed):
    return distance / speed * 60


# %% tags=["wrong", "inverted", "multiplies by the speed"]
def decisions_for(distance, speed):
    return distance * speed * 12


# %% tags=["wrong", "seconds", "seconds for decisions"]
def decisions_for(distance, speed):
    return distance / speed


# %% tags=["wrong", "one-more", "one too many"]
def decisions_for(distance, speed):
    return distance / speed * 12 + 1


# %% tags=["wrong", "not-a-number", "text"]
def decisions_for(distance, speed):
    return str(distance / speed * 12)


# %% tags=["lucky", "the number of the example"]
def decisions_for(distance, speed):
    return 24


# %% tags=["lucky", "a table"]
TABLE = {(6, 2): 36, (6, 4): 18, (6.0, 3.0): 24, (4.0, 2.0): 24, (5.0, 4.5): 13}


def decisions_for(distance, speed):
    return TABLE.get((distance, speed), 20)


# %% tags=["lucky", "a straight line through two points"]
def decisions_for(distance, speed):
    return 36 - 9 * (speed - 2)
