# %% tags=["solution"]
def good(episodes):
    return [episode for episode in episodes if episode.success]


# %% tags=["wrong", "quick"]
def good(episodes):
    return [episode for episode in episodes if episode.seconds < 6]


# %% tags=["wrong", "quick"]
def good(episodes):
    return [episode for episode in episodes if episode.success][:1]
