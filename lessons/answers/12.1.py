# %% tags=["solution"]
def neuron(inputs, weights, bias):
    total = bias
    for number in range(len(inputs)):
        total += weights[number] * inputs[number]
    return math.tanh(total)


# %% tags=["wrong", "late-bias", "numpy, the bias last"]
def neuron(inputs, weights, bias):
    return math.tanh(np.dot(weights, inputs)) + bias


# %% tags=["wrong", "squash"]
def neuron(inputs, weights, bias):
    return np.dot(weights, inputs) + bias


# %% tags=["right", "numpy"]
def neuron(inputs, weights, bias):
    return np.tanh(np.dot(weights, inputs) + bias)


# %% tags=["right", "zip"]
def neuron(inputs, weights, bias):
    return math.tanh(sum(w * x for w, x in zip(weights, inputs)) + bias)


# %% tags=["right", "an array of one"]
def neuron(inputs, weights, bias):
    return np.tanh(np.array([np.dot(weights, inputs) + bias]))


# %% tags=["wrong", "late-bias", "the bias after tanh"]
def neuron(inputs, weights, bias):
    return math.tanh(sum(w * x for w, x in zip(weights, inputs))) + bias


# %% tags=["wrong", "bias", "no bias"]
def neuron(inputs, weights, bias):
    return math.tanh(sum(w * x for w, x in zip(weights, inputs)))


# %% tags=["wrong", "each", "the bias for each input"]
def neuron(inputs, weights, bias):
    return math.tanh(sum(w * x + bias for w, x in zip(weights, inputs)))


# %% tags=["wrong", "weights", "no weights"]
def neuron(inputs, weights, bias):
    return math.tanh(sum(inputs) + bias)


# %% tags=["lucky", "nothing"]
def neuron(inputs, weights, bias):
    return 0


# %% tags=["lucky", "the sign"]
def neuron(inputs, weights, bias):
    return 1 if np.dot(weights, inputs) + bias > 0 else -1


# %% tags=["lucky", "the bias"]
def neuron(inputs, weights, bias):
    return math.tanh(bias)
