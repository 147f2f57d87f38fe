# %% tags=["solution"]
trained = learn(steps=10_000, seed=0)

# %% tags=["wrong", "longer"]
trained = learn(steps=600, seed=0)
