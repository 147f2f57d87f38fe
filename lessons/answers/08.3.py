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


# %% tags=["right", "decorated"]
def diary(agent):
    notes = []

    @agent.begin_of_episode.connect
    def begin(agent):
        notes.append("begin")

    @agent.end_of_step.connect
    def step(agent):
        notes.append("decision")

    @agent.end_of_episode.connect
    def end(agent):
        notes.append("end")

    return notes


# %% tags=["right", "another event"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.begin_of_step.connect(lambda agent: notes.append("decision"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return notes


# %% tags=["wrong", "begins", "no begin"]
def diary(agent):
    notes = []
    agent.end_of_step.connect(lambda agent: notes.append("decision"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return notes


# %% tags=["wrong", "called", "calls in place of connecting"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(notes.append("begin"))
    return notes


# %% tags=["wrong", "begin", "connects the names only"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return notes


# %% tags=["wrong", "no-return", "returns nothing"]
def diary(agent):
    notes = []
    agent.end_of_step.connect(lambda agent: notes.append("decision"))


# %% tags=["lucky", "written beforehand"]
def diary(agent):
    notes = []
    notes += ["begin"] + ["decision"] * agent.max_steps_per_episode + ["end"]
    return notes


# %% tags=["lucky", "seven decisions"]
def diary(agent):
    notes = []
    notes += ["begin"] + ["decision"] * 7 + ["end"]
    return notes


# %% tags=["lucky", "an empty one"]
def diary(agent):
    notes = []
    return notes


# %% tags=["wrong", "late", "functions made in a loop"]
def diary(agent):
    notes = []
    events = [agent.begin_of_episode, agent.end_of_step, agent.end_of_episode]
    for event, word in zip(events, ["begin", "decision", "end"]):
        event.connect(lambda agent: notes.append(word))  # noqa: B023 - the mistake
    return notes


# %% tags=["wrong", "copy", "returns a copy"]
def diary(agent):
    notes = []
    agent.begin_of_episode.connect(lambda agent: notes.append("begin"))
    agent.end_of_step.connect(lambda agent: notes.append("decision"))
    agent.end_of_episode.connect(lambda agent: notes.append("end"))
    return list(notes)
