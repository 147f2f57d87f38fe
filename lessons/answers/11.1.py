# %% tags=["solution"]
def neuron(inputs, weights, bias):
    total = bias
    for number in range(len(inputs)):
        total += weights[number] * inputs[number]
    return math.tanh(total)


# %% tags=["wrong", "bias"]
def neuron(inputs, weights, bias):
    return math.tanh(np.dot(weights, inputs)) + bias


# %% tags=["wrong", "squash"]
def neuron(inputs, weights, bias):
    return np.dot(weights, inputs) + bias
