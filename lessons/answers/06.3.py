# %% tags=["solution"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.end_of_step.connect(lambda agent: notes.append("decision"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return notes


# %% tags=["wrong", "ticks"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.begin_of_apply_action.connect(lambda agent: notes.append("decision"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return notes


# %% tags=["wrong", "end"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.end_of_step.connect(lambda agent: notes.append("decision"))
    return notes
