# %% tags=["solution"]
trained = learn(steps=10_000, seed=0)

# %% tags=["wrong", "longer"]
trained = learn(steps=600, seed=0)


# %% tags=["right", "another seed"]
trained = learn(steps=10_000, seed=1)


# %% tags=["right", "more decisions"]
trained = learn(steps=20_000)


# %% tags=["wrong", "longer", "hardly anything"]
trained = learn(steps=100)


# %% tags=["wrong", "unknown", "the function itself"]
trained = learn


# %% tags=["wrong", "unknown", "the number of decisions"]
trained = 10_000


# %% tags=["wrong", "longer", "an early stop"]
trained = learn(steps=300, seed=2)


# %% tags=["lucky", "another seed, too short"]
trained = learn(steps=200, seed=3)


# %% tags=["lucky", "a file"]
trained = "zoo:box_chase"


# %% tags=["lucky", "short again"]
trained = learn(steps=500, seed=4)
