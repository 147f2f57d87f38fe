# %% tags=["solution"]
def speed_for(distance, seconds):
    return distance / seconds


# %% tags=["right", "with a variable"]
def speed_for(distance, seconds):
    speed = distance / seconds
    print("the robot needs", speed)
    return speed


# %% tags=["right", "rounded"]
def speed_for(distance, seconds):
    return round(distance / seconds, 2)


# %% tags=["right", "by the share of a metre"]
def speed_for(distance, seconds):
    share = 1 / seconds
    return distance * share


# %% tags=["right", "with an if"]
def speed_for(distance, seconds):
    if seconds == 0:
        return 0
    return distance / seconds


# %% tags=["wrong", "no-return", "prints"]
def speed_for(distance, seconds):
    print(distance / seconds)


# %% tags=["wrong", "no-return", "keeps it in a variable"]
def speed_for(distance, seconds):
    speed = distance / seconds


# %% tags=["wrong", "inverted", "upside down"]
def speed_for(distance, seconds):
    return seconds / distance


# %% tags=["wrong", "times", "multiplies"]
def speed_for(distance, seconds):
    return distance * seconds


# %% tags=["wrong", "whole", "whole metres"]
def speed_for(distance, seconds):
    return distance // seconds


# %% tags=["wrong", "distance", "the distance"]
def speed_for(distance, seconds):
    return distance


# %% tags=["wrong", "same", "numbers of its own"]
def speed_for(distance, seconds):
    distance = 6
    seconds = 3
    return distance / seconds


# %% tags=["wrong", "error", "words in place of variables"]
def speed_for(distance, seconds):
    return "distance" / "seconds"


# %% tags=["lucky", "the number of the hint"]
def speed_for(distance, seconds):
    return 2


# %% tags=["lucky", "a usual speed"]
def speed_for(distance, seconds):
    if distance > 5:
        return 2
    return 1.5


# %% tags=["lucky", "half the distance"]
def speed_for(distance, seconds):
    return distance / 2


# %% tags=["lucky", "by chance"]
import random


def speed_for(distance, seconds):
    return random.uniform(1, 3)
