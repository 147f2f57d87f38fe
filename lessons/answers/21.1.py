# %% tags=["solution"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if blue < 0.5 else 0]}


# %% tags=["right", "two conditions"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    is_orange = red > 0.7 and brightness < 0.9
    return {"move": [0.8, 0, 0, 0], "pen": [float(is_orange)]}


# %% tags=["right", "more red than blue"]
def paint(percept):
    colour = percept["colour"]
    if colour[0] > colour[2] + 0.3:
        return {"move": [1, 0, 0, 0], "pen": [1]}
    return {"move": [1, 0, 0, 0], "pen": [0]}


# %% tags=["wrong", "bright", "by brightness"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if brightness < 0.8 else 0]}


# %% tags=["wrong", "paper", "by red alone"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if red > 0.7 else 0]}


# %% tags=["wrong", "always", "pen down"]
def paint(percept):
    return {"move": [1, 0, 0, 0], "pen": [1]}


# %% tags=["wrong", "reversed", "where there is blue"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if blue > 0.5 else 0]}


# %% tags=["wrong", "other", "the blue stripes"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if red < 0.5 else 0]}


# %% tags=["wrong", "begin", "numbers up to 255"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [1 if red > 200 and blue < 100 else 0]}


# %% tags=["wrong", "stands", "stops to draw"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    if blue < 0.5:
        return {"move": [0, 0, 0, 0], "pen": [1]}
    return {"move": [1, 0, 0, 0], "pen": [0]}


# %% tags=["wrong", "away", "turns"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0.1, 0, 0], "pen": [1 if blue < 0.5 else 0]}


# %% tags=["lucky", "by chance"]
import random


def paint(percept):
    return {"move": [1, 0, 0, 0], "pen": [random.choice([0, 1])]}


# %% tags=["lucky", "by the clock"]
count = 0


def paint(percept):
    global count
    count = count + 1
    return {"move": [1, 0, 0, 0], "pen": [1 if count % 28 < 10 else 0]}


# %% tags=["lucky", "up and down"]
is_down = False


def paint(percept):
    global is_down
    is_down = not is_down
    return {"move": [1, 0, 0, 0], "pen": [1 if is_down else 0]}
