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
