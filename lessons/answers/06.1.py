# %% tags=["solution"]
def blind_way(speed, skip_frame):
    ticks = skip_frame + 1
    return speed * ticks / 60


# %% tags=["wrong", "one-more"]
def blind_way(speed, skip_frame):
    return speed * skip_frame / 60


# %% tags=["wrong", "seconds"]
def blind_way(speed, skip_frame):
    return speed * (skip_frame + 1)
