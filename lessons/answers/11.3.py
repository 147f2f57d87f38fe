# %% tags=["solution"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    for _ in range(300):
        sim.step()
        if touched(blue) or (purple.done and not touched(purple)):
            return "blue"
        if touched(purple) or blue.done:
            return "purple"
    return None  # time is up


# %% tags=["wrong", "fell"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    for _ in range(300):
        sim.step()
        if blue.done:
            return "blue"
        if purple.done:
            return "purple"
    return None


# %% tags=["wrong", "time"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    while True:
        sim.step()
        if touched(blue) or (purple.done and not touched(purple)):
            return "blue"
        if touched(purple) or blue.done:
            return "purple"


# %% tags=["right", "a loop with a condition"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    steps = 0
    while not (blue.done or purple.done) and steps < 300:
        sim.step()
        steps += 1
    if blue.done:
        return "blue" if touched(blue) else "purple"
    if purple.done:
        return "purple" if touched(purple) else "blue"
    return None


# %% tags=["right", "by the names"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    for _ in range(300):
        sim.step()
        for agent, other in ((blue, purple), (purple, blue)):
            if agent.done:
                return agent.id if touched(agent) else other.id


# %% tags=["wrong", "begin", "nobody runs"]
def race(sim, seed):
    return "blue"


# %% tags=["wrong", "unknown", "returns the agent"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    for _ in range(300):
        sim.step()
        if blue.done:
            return blue
        if purple.done:
            return purple


# %% tags=["wrong", "begin", "one step"]
def race(sim, seed):
    blue, purple = sim.agents
    sim.reset(seed)
    sim.step()
    return "blue" if blue.done else "purple"


# %% tags=["lucky", "always purple"]
def race(sim, seed):
    return "purple"


# %% tags=["lucky", "the seed decides"]
def race(sim, seed):
    return "blue" if seed % 2 else "purple"


# %% tags=["lucky", "nobody"]
def race(sim, seed):
    return None
