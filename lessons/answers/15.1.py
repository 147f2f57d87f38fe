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


# %% tags=["right", "with sense"]
def script(robot):
    percept = robot.sense()
    while not percept.done:
        ahead = percept["orientation"][0] > 0.97
        robot.act(move=[1, 0, 0, 0] if ahead else [0, 0.3, 0, 0])
        percept = robot.sense()


# %% tags=["right", "slowly"]
def script(robot):
    for percept in robot:
        if percept["orientation"][0] > 0.99:
            robot.act(move=[0.6, 0, 0, 0])
        else:
            robot.act(move=[0, 0.2, 0, 0])


# %% tags=["wrong", "look", "straight on"]
def script(robot):
    for percept in robot:
        robot.act(move=[1, 0, 0, 0])


# %% tags=["wrong", "loop", "three decisions"]
def script(robot):
    for _ in range(3):
        robot.act(move=[1, 0, 0, 0])
        robot.sense()


# %% tags=["wrong", "loop", "nothing"]
def script(robot):
    return robot.sense()


# %% tags=["wrong", "error", "another name"]
def script(robot):
    for percept in robot:
        robot.act(drive=[1, 0, 0, 0])


# %% tags=["lucky", "circles"]
def script(robot):
    for percept in robot:
        robot.act(move=[0.3, 0.2, 0, 0])


# %% tags=["lucky", "by chance"]
import random


def script(robot):
    for percept in robot:
        robot.act(move=[random.uniform(-1, 1), random.uniform(-1, 1), 0, 0])


# %% tags=["lucky", "turns only"]
def script(robot):
    for percept in robot:
        robot.act(move=[0, 0.2, 0, 0])
