# %% tags=["solution"]
def script(robot):
    for percept in robot:
        looks_at_it = percept["orientation"][0] > 0.99
        robot.act(move=[1, 0, 0, 0] if looks_at_it else [0, 0.2, 0, 0])


# %% tags=["wrong", "loop"]
def script(robot):
    percept = robot.sense()
    looks_at_it = percept["orientation"][0] > 0.99
    robot.act(move=[1, 0, 0, 0] if looks_at_it else [0, 0.2, 0, 0])


# %% tags=["wrong", "look"]
def script(robot):
    for _ in robot:
        robot.act(move=[0.5, 0.3, 0, 0])
