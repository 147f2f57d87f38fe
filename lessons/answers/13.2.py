# %% tags=["solution"]
def influence(ask, percept, key):
    blind = {**percept, key: 0 * percept[key]}
    return abs(ask(blind)[1] - ask(percept)[1])


# %% tags=["right", "a copy that is changed"]
def influence(ask, percept, key):
    changed = dict(percept)
    changed[key] = np.zeros_like(percept[key])
    before, after = ask(percept), ask(changed)
    return abs(before[1] - after[1])


# %% tags=["right", "max of both signs"]
def influence(ask, percept, key):
    turn = ask(percept)[1]
    other = ask({name: x * (name != key) for name, x in percept.items()})[1]
    return max(turn - other, other - turn)


# %% tags=["right", "changes it and puts it back"]
def influence(ask, percept, key):
    before = ask(percept)[1]
    kept = percept[key]
    percept[key] = 0 * kept
    after = ask(percept)[1]
    percept[key] = kept
    return abs(after - before)


# %% tags=["wrong", "same", "changes it too early"]
def influence(ask, percept, key):
    percept[key] = 0 * percept[key]
    return abs(ask(percept)[1] - ask(percept)[1])


# %% tags=["wrong", "spoiled", "changes the given one"]
def influence(ask, percept, key):
    before = ask(percept)[1]
    percept[key] = 0 * percept[key]
    return abs(ask(percept)[1] - before)


# %% tags=["wrong", "signed", "without abs"]
def influence(ask, percept, key):
    return ask(percept)[1] - ask({**percept, key: 0 * percept[key]})[1]


# %% tags=["wrong", "forward", "the first number"]
def influence(ask, percept, key):
    return abs(ask(percept)[0] - ask({**percept, key: 0 * percept[key]})[0])


# %% tags=["wrong", "part", "only the first number is 0"]
def influence(ask, percept, key):
    reading = percept[key].copy()
    reading[0] = 0
    return abs(ask(percept)[1] - ask({**percept, key: reading})[1])


# %% tags=["wrong", "ones", "ones for zeros"]
def influence(ask, percept, key):
    return abs(ask(percept)[1] - ask({**percept, key: np.ones_like(percept[key])})[1])


# %% tags=["wrong", "other", "takes the others away"]
def influence(ask, percept, key):
    alone = {name: x * (name == key) for name, x in percept.items()}
    return abs(ask(percept)[1] - ask(alone)[1])


# %% tags=["wrong", "begin", "forgets to compare"]
def influence(ask, percept, key):
    return ask({**percept, key: 0 * percept[key]})[1]


# %% tags=["lucky", "a constant"]
def influence(ask, percept, key):
    return 0.5


# %% tags=["lucky", "the size of the reading"]
def influence(ask, percept, key):
    return float(np.abs(percept[key]).sum())


# %% tags=["lucky", "the turn itself"]
def influence(ask, percept, key):
    return abs(ask(percept)[1])
