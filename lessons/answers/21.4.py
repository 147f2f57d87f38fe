# %% tags=["solution"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [1, x / 10, y / 10]}


def run(percept):
    heard, first, second = percept["hear"]
    if heard == 0:
        return {"move": [0, 0, 0, 0]}
    return go_to(percept, 10 * first, 10 * second)


# %% tags=["right", "a code of their own"]
def spot(percept):
    return {"speak": [1, -percept["flag"][1] / 8, percept["flag"][0] / 16]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 16 * second, -8 * first)


# %% tags=["right", "says it once, and the robot remembers"]
said = 0
place = None


def spot(percept):
    global said
    said = said + 1
    x, y, height = percept["flag"]
    return {"speak": [1 if said % 7 == 0 else 0, x / 10, y / 10]}


def run(percept):
    global place
    heard, first, second = percept["hear"]
    if heard == 1:
        place = (10 * first, 10 * second)
    if place is None:
        return {"move": [0, 0, 0, 0]}
    return go_to(percept, *place)


# %% tags=["wrong", "silent"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [0, x / 10, y / 10]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 10 * first, 10 * second)


# %% tags=["wrong", "deaf"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [1, x / 10, y / 10]}


def run(percept):
    return go_to(percept, 3, 3)


# %% tags=["wrong", "range", "says metres"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [1, x, y]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, first, second)


# %% tags=["wrong", "code", "forgets to multiply"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [1, x / 10, y / 10]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, first, second)


# %% tags=["wrong", "code", "swaps x and y"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [1, x / 10, y / 10]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 10 * second, 10 * first)


# %% tags=["wrong", "elsewhere", "a variable that both know"]
there = [0, 0]


def spot(percept):
    there[0], there[1] = percept["flag"][0], percept["flag"][1]
    return {"speak": [1, 0.1, 0.1]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, there[0] + 0.01 * first, there[1] + 0.01 * second)


# %% tags=["lucky", "circles"]
def spot(percept):
    return {"speak": [1, 0.5, 0.5]}


def run(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "the same place each time"]
def spot(percept):
    return {"speak": [1, 0.3, 0.4]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 10 * first, 10 * second)


# %% tags=["lucky", "by chance"]
import random


def spot(percept):
    return {"speak": [1, random.uniform(-1, 1), random.uniform(-1, 1)]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 8 * first, 8 * second)
