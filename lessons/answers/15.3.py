# %% tags=["solution"]
def full_power(robot):
    return robot.spaces.action.high


# %% tags=["wrong", "ask"]
def full_power(robot):
    return [1, 1, 1, 1]


# %% tags=["wrong", "full"]
def full_power(robot):
    return robot.spaces.action.low


# %% tags=["right", "a list"]
def full_power(robot):
    return [float(each) for each in robot.spaces.action.high]


# %% tags=["right", "by index"]
def full_power(robot):
    high = robot.spaces.action.high
    return [high[number] for number in range(len(high))]


# %% tags=["wrong", "one", "a 1 for each"]
def full_power(robot):
    return [1] * len(robot.spaces.action.high)


# %% tags=["wrong", "full", "half of it"]
def full_power(robot):
    return robot.spaces.action.high / 2


# %% tags=["wrong", "no-return", "prints"]
def full_power(robot):
    print(robot.spaces.action.high)


# %% tags=["wrong", "ask", "the first number"]
def full_power(robot):
    return robot.spaces.action.high[:1]


# %% tags=["lucky", "two numbers"]
def full_power(robot):
    return [1, 1]


# %% tags=["lucky", "nothing"]
def full_power(robot):
    return []


# %% tags=["lucky", "a dictionary"]
def full_power(robot):
    return {"move": [1, 1, 1, 1]}


# %% tags=["lucky", "a table by the number of numbers"]
def full_power(robot):
    count = len(robot.spaces.action.high)
    return {4: [1, 1, 1, 1], 3: [3, 0.5, 0.25], 2: [1, 1]}.get(count, [1] * count)
