# %% tags=["solution"]
def think(inputs, layers):
    signal = inputs
    for weights, bias in layers[:-1]:
        signal = np.tanh(weights @ signal + bias)
    weights, bias = layers[-1]
    return weights @ signal + bias


# %% tags=["wrong", "last"]
def think(inputs, layers):
    signal = inputs
    for weights, bias in layers:
        signal = np.tanh(weights @ signal + bias)
    return signal


# %% tags=["wrong", "between"]
def think(inputs, layers):
    signal = inputs
    for weights, bias in layers:
        signal = weights @ signal + bias
    return signal


# %% tags=["right", "counted"]
def think(inputs, layers):
    signal = inputs
    for number, (weights, bias) in enumerate(layers):
        signal = np.dot(weights, signal) + bias
        if number < len(layers) - 1:
            signal = np.tanh(signal)
    return signal


# %% tags=["right", "pure Python"]
def think(inputs, layers):
    signal = list(inputs)
    for number, (weights, bias) in enumerate(layers):
        signal = [sum(w * x for w, x in zip(row, signal)) + b for row, b in zip(weights, bias)]
        if number < len(layers) - 1:
            signal = [math.tanh(each) for each in signal]
    return signal


# %% tags=["wrong", "biases", "no biases"]
def think(inputs, layers):
    signal = inputs
    for weights, bias in layers[:-1]:
        signal = np.tanh(weights @ signal)
    return layers[-1][0] @ signal


# %% tags=["wrong", "no-return", "returns nothing"]
def think(inputs, layers):
    signal = inputs
    for weights, bias in layers:
        signal = weights @ signal + bias


# %% tags=["wrong", "error", "the first layer only"]
def think(inputs, layers):
    weights, bias = layers[0]
    return (weights @ inputs + bias)[: len(layers[-1][1])] if len(layers) == 1 else layers[9]


# %% tags=["lucky", "nothing"]
def think(inputs, layers):
    return np.zeros(len(layers[-1][1]))


# %% tags=["lucky", "the biases"]
def think(inputs, layers):
    return layers[-1][1]


# %% tags=["lucky", "by chance"]
def think(inputs, layers):
    return np.random.default_rng(1).normal(size=len(layers[-1][1]))
