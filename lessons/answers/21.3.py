# %% tags=["solution"]
def where(hear, before):
    heard, x, y = hear
    if heard == 1:
        return [10 * x, 10 * y]
    return before


# %% tags=["right", "silence first"]
def where(hear, before):
    if hear[0] == 0:
        return before
    return hear[1:] * 10


# %% tags=["right", "a loop"]
def where(hear, before):
    if hear[0] > 0.5:
        return [10 * number for number in hear[1:]]
    return list(before)


# %% tags=["wrong", "silence", "takes silence for the middle"]
def where(hear, before):
    heard, x, y = hear
    return [10 * x, 10 * y]


# %% tags=["wrong", "flag", "asks whether x and y are 0"]
def where(hear, before):
    heard, x, y = hear
    if x == 0 and y == 0:
        return before
    return [10 * x, 10 * y]


# %% tags=["wrong", "flag", "asks whether one of them is 0"]
def where(hear, before):
    heard, x, y = hear
    if x != 0 and y != 0:
        return [10 * x, 10 * y]
    return before


# %% tags=["wrong", "flag", "asks for x alone"]
def where(hear, before):
    heard, x, y = hear
    if x:
        return [10 * x, 10 * y]
    return before


# %% tags=["wrong", "scale", "no metres"]
def where(hear, before):
    heard, x, y = hear
    if heard == 1:
        return [x, y]
    return before


# %% tags=["wrong", "swapped"]
def where(hear, before):
    heard, y, x = hear
    if heard == 1:
        return [10 * x, 10 * y]
    return before


# %% tags=["wrong", "begin", "stays"]
def where(hear, before):
    return before


# %% tags=["wrong", "no-return", "nothing at silence"]
def where(hear, before):
    heard, x, y = hear
    if heard == 1:
        return [10 * x, 10 * y]


# %% tags=["lucky", "the middle"]
def where(hear, before):
    return [0, 0]


# %% tags=["lucky", "the first place"]
def where(hear, before):
    return [3, 4]


# %% tags=["lucky", "halfway"]
def where(hear, before):
    return [5 * hear[1] + before[0] / 2, 5 * hear[2] + before[1] / 2]
