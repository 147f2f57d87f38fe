# %% tags=["solution"]
def twin(x, y):
    return (x, -y)  # as in a mirror that lies along the robot's nose


# %% tags=["wrong", "behind"]
def twin(x, y):
    return (-x, y)


# %% tags=["wrong", "far"]
def twin(x, y):
    return (2 * x, -2 * y)
