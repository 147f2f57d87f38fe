# %% tags=["solution"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [name for name, size in zip(told.names, told.importance) if size == 0]


# %% tags=["right", "by hand"]
def blind(policy, percept, baseline):
    names = []
    for name in percept:
        other = {**percept, name: baseline[name]}
        if (policy(other)["move"] == policy(percept)["move"]).all():
            names.append(name)
    return names


# %% tags=["right", "a small threshold"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [told.names[n] for n in range(len(told.names)) if abs(told.shift[n]).max() < 0.001]


# %% tags=["wrong", "begin", "none"]
def blind(policy, percept, baseline):
    return []


# %% tags=["wrong", "used", "the readings that matter"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [name for name, size in zip(told.names, told.importance) if size > 0]


# %% tags=["wrong", "side", "only to one side"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [name for name, moved in zip(told.names, told.shift) if moved.max() <= 0]


# %% tags=["wrong", "slots", "single numbers"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline)
    return [name for name, size in zip(told.names, told.importance) if size == 0]


# %% tags=["wrong", "one", "the least of all"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [told.names[told.importance.argmin()]]


# %% tags=["lucky", "all of them"]
def blind(policy, percept, baseline):
    return list(percept)


# %% tags=["lucky", "the lamp"]
def blind(policy, percept, baseline):
    return ["lamp"]


# %% tags=["lucky", "nothing at all"]
def blind(policy, percept, baseline):
    return None


# %% tags=["wrong", "little", "less than a tenth"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [name for name, size in zip(told.names, told.importance) if size < 0.1]


# %% tags=["wrong", "little", "less than a twentieth"]
def blind(policy, percept, baseline):
    told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")
    return [name for name, size in zip(told.names, told.importance) if size < 0.05]
