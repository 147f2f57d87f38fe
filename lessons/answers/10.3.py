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
