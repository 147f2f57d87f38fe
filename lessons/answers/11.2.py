# %% tags=["solution"]
weights = [
    [0, 0],  # forward: whatever it senses,
    [-5, 0],  # turn: to the left (below 0) when the sine is above 0
]
bias = [1, 0]  # it drives on

# %% tags=["wrong", "mirrored"]
weights = [[0, 0], [5, 0]]
bias = [1, 0]

# %% tags=["wrong", "begin"]
weights = [[0, 1], [0, 0]]
bias = [0, 0]
