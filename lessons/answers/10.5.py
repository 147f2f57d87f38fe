# %% tags=["solution"]
def looks_most_at(told):
    sizes = [max(abs(each) for each in moved) for moved in told.shift]
    return told.names[sizes.index(max(sizes))]


# %% tags=["right", "with importance"]
def looks_most_at(told):
    return told.names[told.importance.argmax()]


# %% tags=["right", "with strongest"]
def looks_most_at(told):
    return told.names[told.strongest()]


# %% tags=["wrong", "first", "the first one"]
def looks_most_at(told):
    return told.names[0]


# %% tags=["wrong", "sign", "to one side only"]
def looks_most_at(told):
    return told.names[told.shift.max(axis=1).argmax()]


# %% tags=["wrong", "sum", "the sum"]
def looks_most_at(told):
    return told.names[abs(told.shift).sum(axis=1).argmax()]


# %% tags=["wrong", "name", "the number"]
def looks_most_at(told):
    return int(told.importance.argmax())


# %% tags=["lucky", "the box"]
def looks_most_at(told):
    return "box"


# %% tags=["lucky", "the last one"]
def looks_most_at(told):
    return told.names[-1]


# %% tags=["lucky", "the longest name"]
def looks_most_at(told):
    return max(told.names, key=len)


# %% tags=["lucky", "always ray 2"]
def looks_most_at(told):
    return "ray 2"
