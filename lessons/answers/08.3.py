# %% tags=["solution"]
def full_power(robot):
    return robot.spaces.action.high


# %% tags=["wrong", "ask"]
def full_power(robot):
    return [1, 1, 1, 1]


# %% tags=["wrong", "full"]
def full_power(robot):
    return robot.spaces.action.low
