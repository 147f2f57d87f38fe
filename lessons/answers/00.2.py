# %% tags=["solution"]
def turn_left(percept):
    return {"move": [0, -1, 0, 0]}


# %% tags=["wrong", "right"]
def turn_left(percept):
    return {"move": [0, 1, 0, 0]}


# %% tags=["wrong", "moved"]
def turn_left(percept):
    return {"move": [1, -1, 0, 0]}


# %% tags=["right", "slowly"]
def turn_left(percept):
    return {"move": [0, -0.3, 0, 0]}


# %% tags=["right", "hardly forward"]
def turn_left(percept):
    return {"move": [0.01, -0.5, 0, 0]}


# %% tags=["wrong", "still", "turns by nothing"]
def turn_left(percept):
    return {"move": [0, -0.001, 0, 0]}


# %% tags=["wrong", "moved", "turns by the first number"]
def turn_left(percept):
    return {"move": [-1, 0, 0, 0]}


# %% tags=["wrong", "no-return", "prints in place of returning"]
def turn_left(percept):
    print({"move": [0, -1, 0, 0]})


# %% tags=["lucky", "towards the box"]
def turn_left(percept):
    return {"move": [0, -percept["orientation"][0], 0, 0]}


# %% tags=["lucky", "left and right in turn"]
count = 0


def turn_left(percept):
    global count
    count = count + 1
    return {"move": [0, 1 if count % 2 else -1, 0, 0]}


# %% tags=["lucky", "left once"]
count = 0


def turn_left(percept):
    global count
    count = count + 1
    return {"move": [0, -1 if count == 1 else 0.6, 0, 0]}
