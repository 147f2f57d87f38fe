# %% tags=["solution"]
weights = [
    [0, 0],  # forward: whatever it senses,
    [-5, 0],  # turn: to the left (below 0) when the sine is above 0
]
bias = [1, 0]  # it drives on

# %% tags=["wrong", "mirrored"]
weights = [[0, 0], [5, 0]]
bias = [1, 0]

# %% tags=["wrong", "blind", "does not turn"]
weights = [[0, 1], [0, 0]]
bias = [0, 0]


# %% tags=["right", "arrays"]
weights = np.array([[0, 0], [-3, 0]])
bias = np.array([1, 0])


# %% tags=["right", "drives where it looks"]
weights = [[0, 2], [-5, 0]]
bias = [-1, 0]


# %% tags=["right", "a large turn"]
weights = [[0, 0], [-20, 0]]
bias = [0.7, 0]


# %% tags=["wrong", "swapped", "rows and columns swapped"]
weights = [[0, -5], [0, 0]]
bias = [1, 0]


# %% tags=["wrong", "begin", "all zero"]
weights = [[0, 0], [0, 0]]
bias = [0, 0]


# %% tags=["wrong", "blind", "straight on"]
weights = [[0, 0], [0, 0]]
bias = [1, 0]


# %% tags=["wrong", "still", "never drives"]
weights = [[0, 0], [-5, 0]]
bias = [0, 0]


# %% tags=["wrong", "unknown", "three rows"]
weights = [[0, 0], [-5, 0], [0, 0]]
bias = [1, 0]


# %% tags=["lucky", "ones"]
weights = [[1, 1], [1, 1]]
bias = [1, 1]


# %% tags=["lucky", "a circle"]
weights = [[0, 0], [0, 0]]
bias = [0.5, 0.3]


# %% tags=["lucky", "minus ones"]
weights = [[-1, -1], [-1, -1]]
bias = [-1, -1]
