# %% tags=["solution"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, infos = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, terminations, truncations, infos = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


# %% tags=["right", "a list of who is left"]
def play(env, policies, seed):
    seen, _ = env.reset(seed=seed)
    left, totals = list(env.agents), {}
    while left:
        seen, rewards, ended, cut, _ = env.step({name: policies[name](seen[name]) for name in left})
        for name in left:
            totals[name] = totals.get(name, 0) + rewards[name]
        left = [name for name in left if not ended[name] and not cut[name]]
    return totals


# %% tags=["right", "keeps all rewards"]
def play(env, policies, seed):
    observations, _ = env.reset(seed=seed)
    paid = {name: [] for name in env.agents}
    while len(env.agents) > 0:
        actions = {}
        for name in env.agents:
            actions[name] = policies[name](observations[name])
        observations, rewards, *_ = env.step(actions)
        for name in rewards:
            paid[name].append(rewards[name])
    return {name: sum(each) for name, each in paid.items()}


# %% tags=["right", "actions for all who were seen"]
def play(env, policies, seed):
    totals = {name: 0.0 for name in env.possible_agents}
    observations = env.reset(seed=seed)[0]
    while env.agents:
        step = env.step({name: policies[name](seen) for name, seen in observations.items()})
        observations = step[0]
        for name in step[1]:
            totals[name] = totals[name] + step[1][name]
    return totals


# %% tags=["wrong", "begin", "nothing"]
def play(env, policies, seed):
    return dict.fromkeys(env.possible_agents, 0)


# %% tags=["wrong", "first", "ends with the first one"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    over = False
    while not over:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, ended, cut, _ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
        over = any(ended.values()) or any(cut.values())
    return totals


# %% tags=["wrong", "over", "forgets truncations"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    out = set()
    while len(out) < len(totals):
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, ended, cut, _ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
            if ended[name]:
                out.add(name)
    return totals


# %% tags=["wrong", "lost", "forgets the last reward"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        for name in env.agents:
            totals[name] += rewards[name]
    return totals


# %% tags=["wrong", "last", "the last reward only"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        totals.update(rewards)
    return totals


# %% tags=["wrong", "stale", "old observations"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        _, rewards, *_ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


# %% tags=["wrong", "policy", "one policy for all"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    policy = policies[env.possible_agents[0]]
    while env.agents:
        actions = {name: policy(observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


# %% tags=["wrong", "seed", "without the seed"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset()
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


# %% tags=["wrong", "all", "one sum for all"]
def play(env, policies, seed):
    total = 0
    observations, _ = env.reset(seed=seed)
    while env.agents:
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        total += sum(rewards.values())
    return total


# %% tags=["lucky", "three steps"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    observations, _ = env.reset(seed=seed)
    for _ in range(3):
        actions = {name: policies[name](observations[name]) for name in env.agents}
        observations, rewards, *_ = env.step(actions)
        for name, reward in rewards.items():
            totals[name] += reward
    return totals


# %% tags=["lucky", "the same number for each"]
def play(env, policies, seed):
    env.reset(seed=seed)
    return dict.fromkeys(env.possible_agents, 10)


# %% tags=["lucky", "what the game keeps"]
def play(env, policies, seed):
    env.reset(seed=seed)
    return getattr(env, "totals", {})
