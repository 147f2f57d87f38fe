# %% tags=["solution"]
def decisions_for_quarter(degrees_per_second):
    return 90 / degrees_per_second * 12


# %% tags=["wrong", "other-speed"]
def decisions_for_quarter(degrees_per_second):
    return 9


# %% tags=["wrong", "time"]
def decisions_for_quarter(degrees_per_second):
    return 90 / degrees_per_second
