# %% tags=["solution"]
def decisions_for_quarter(degrees_per_second):
    return 90 / degrees_per_second * 12


# %% tags=["wrong", "other-speed"]
def decisions_for_quarter(degrees_per_second):
    return 9


# %% tags=["right", "degrees a decision"]
def decisions_for_quarter(degrees_per_second):
    return 90 / (degrees_per_second / 12)


# %% tags=["right", "in radians"]
def decisions_for_quarter(degrees_per_second):
    quarter = math.pi / 2
    return round(12 * quarter / math.radians(degrees_per_second))


# %% tags=["wrong", "ticks", "ticks for decisions"]
def decisions_for_quarter(degrees_per_second):
    return 90 / degrees_per_second * 60


# %% tags=["wrong", "inverted", "upside down"]
def decisions_for_quarter(degrees_per_second):
    return degrees_per_second / 90 * 12


# %% tags=["wrong", "seconds", "seconds for decisions"]
def decisions_for_quarter(degrees_per_second):
    return 90 / degrees_per_second


# %% tags=["wrong", "time", "a full turn"]
def decisions_for_quarter(degrees_per_second):
    return 360 / degrees_per_second * 12


# %% tags=["lucky", "one turn more"]
def decisions_for_quarter(degrees_per_second):
    return 450 / degrees_per_second * 12


# %% tags=["lucky", "a table"]
TABLE = {120: 9, 60: 18, 90: 12, 180: 6, 45: 24}


def decisions_for_quarter(degrees_per_second):
    return TABLE.get(degrees_per_second, 10)


# %% tags=["lucky", "never below 6"]
def decisions_for_quarter(degrees_per_second):
    return max(6, 20 - degrees_per_second // 12)
