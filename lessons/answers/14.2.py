# %% tags=["solution"]
def reinforce(preferences, episode, rate, discount):
    after = preferences.copy()
    worth = 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth  # what came from this step on
        step = -softmax(preferences[cell])
        step[action] += 1  # the gradient of the logarithm of its probability
        after[cell] += rate * worth * step
    return after


# %% tags=["right", "one after another"]
def reinforce(preferences, episode, rate, discount):
    worth = 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        chances = softmax(preferences[cell])
        for other in range(len(chances)):
            preferences[cell, other] += rate * worth * ((other == action) - chances[other])
    return preferences


# %% tags=["right", "forward, with sums"]
def reinforce(preferences, episode, rate, discount):
    after = np.array(preferences)
    for n, (cell, action, _) in enumerate(episode):
        worth = sum(discount**k * step[2] for k, step in enumerate(episode[n:]))
        after[cell] += rate * worth * (np.eye(after.shape[1])[action] - softmax(preferences[cell]))
    return after


# %% tags=["right", "later steps count less"]
def reinforce(preferences, episode, rate, discount):
    after = preferences.copy()
    for n, (cell, action, _) in enumerate(episode):
        worth = sum(discount**k * step[2] for k, step in enumerate(episode[n:]))
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * discount**n * worth * step
    return after


# %% tags=["wrong", "begin", "nothing"]
def reinforce(preferences, episode, rate, discount):
    return preferences


# %% tags=["wrong", "sign", "downhill"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] -= rate * worth * step
    return after


# %% tags=["wrong", "onehot", "only the action taken"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        after[cell, action] += rate * worth
    return after


# %% tags=["wrong", "probability", "the gradient of the probability"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        chances = softmax(preferences[cell])
        step = -chances
        step[action] += 1
        after[cell] += rate * worth * chances[action] * step
    return after


# %% tags=["wrong", "reward", "the step's own reward"]
def reinforce(preferences, episode, rate, discount):
    after = preferences.copy()
    for cell, action, reward in episode:
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * reward * step
    return after


# %% tags=["wrong", "undiscounted", "no discount"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in reversed(episode):
        worth += reward
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * worth * step
    return after


# %% tags=["wrong", "past", "the whole return for each step"]
def reinforce(preferences, episode, rate, discount):
    after = preferences.copy()
    worth = sum(discount**n * reward for n, (_, _, reward) in enumerate(episode))
    for cell, action, _ in episode:
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * worth * step
    return after


# %% tags=["wrong", "forward", "sums up from the wrong end"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in episode:
        worth = reward + discount * worth
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += rate * worth * step
    return after


# %% tags=["wrong", "rate", "no learning rate"]
def reinforce(preferences, episode, rate, discount):
    after, worth = preferences.copy(), 0
    for cell, action, reward in reversed(episode):
        worth = reward + discount * worth
        step = -softmax(preferences[cell])
        step[action] += 1
        after[cell] += worth * step
    return after


# %% tags=["lucky", "always to the right"]
def reinforce(preferences, episode, rate, discount):
    preferences[:, 1] += rate
    return preferences


# %% tags=["lucky", "zeros"]
def reinforce(preferences, episode, rate, discount):
    return np.zeros_like(preferences)


# %% tags=["lucky", "by chance"]
def reinforce(preferences, episode, rate, discount):
    return np.random.default_rng(1).normal(size=preferences.shape)
