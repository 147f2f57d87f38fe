# %% tags=["solution"]
def good(episodes):
    return [episode for episode in episodes if episode.success]


# %% tags=["wrong", "quick", "the quick ones"]
def good(episodes):
    return [episode for episode in episodes if episode.seconds < 6]


# %% tags=["wrong", "some", "only one"]
def good(episodes):
    return [episode for episode in episodes if episode.success][:1]


# %% tags=["right", "a loop"]
def good(episodes):
    chosen = []
    for episode in episodes:
        if episode.success:
            chosen.append(episode)
    return chosen


# %% tags=["right", "filter"]
def good(episodes):
    return list(filter(lambda episode: episode.success, episodes))


# %% tags=["wrong", "all", "all of them"]
def good(episodes):
    return episodes


# %% tags=["wrong", "parts", "their seeds"]
def good(episodes):
    return [episode.seed for episode in episodes if episode.success]


# %% tags=["wrong", "none", "nothing"]
def good(episodes):
    return []


# %% tags=["wrong", "no-return", "prints"]
def good(episodes):
    print([episode for episode in episodes if episode.success])


# %% tags=["wrong", "twice", "one of them twice"]
def good(episodes):
    chosen = [episode for episode in episodes if episode.success]
    return chosen[:3] * 2


# %% tags=["lucky", "all but the first three"]
def good(episodes):
    return episodes[3:]


# %% tags=["lucky", "the slow ones"]
def good(episodes):
    return [episode for episode in episodes if episode.seconds > 1.5]


# %% tags=["lucky", "the first three"]
def good(episodes):
    return episodes[:3]
