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


# %% tags=["right", "by seconds"]
def blind_way(speed, skip_frame):
    seconds = (skip_frame + 1) * (1 / 60)
    return seconds * speed


# %% tags=["right", "added up"]
def blind_way(speed, skip_frame):
    way = 0
    for tick in range(skip_frame + 1):
        way += speed / 60
    return way


# %% tags=["wrong", "twelve", "always twelve decisions a second"]
def blind_way(speed, skip_frame):
    return speed / 12


# %% tags=["wrong", "ticks", "seconds for metres"]
def blind_way(speed, skip_frame):
    return (skip_frame + 1) / 60


# %% tags=["wrong", "begin", "nothing"]
def blind_way(speed, skip_frame):
    return 0


# %% tags=["wrong", "no-return", "prints"]
def blind_way(speed, skip_frame):
    print(speed * (skip_frame + 1) / 60)


# %% tags=["lucky", "a constant"]
def blind_way(speed, skip_frame):
    return 0.25


# %% tags=["lucky", "a table"]
TABLE = {(2.0, 4): 0.167, (3.0, 0): 0.05}


def blind_way(speed, skip_frame):
    return TABLE.get((speed, skip_frame), 0.2)


# %% tags=["lucky", "the speed alone"]
def blind_way(speed, skip_frame):
    return speed / 10
