# %% tags=["solution"]
prediction = "lingers"  # a touch ends the payments for being near
hacked = learn_wrong_reward()

# %% tags=["right", "another seed"]
hacked = learn_wrong_reward(seed=1)
prediction = "lingers"

# %% tags=["right", "longer"]
prediction = "lingers"
hacked = learn_wrong_reward(steps=4000)

# %% tags=["wrong", "touches", "what was meant"]
prediction = "touches"
hacked = learn_wrong_reward()

# %% tags=["wrong", "falls", "the jumper of lesson 09"]
prediction = "falls"
hacked = learn_wrong_reward()

# %% tags=["wrong", "name", "no guess"]
prediction = "?"
hacked = learn_wrong_reward()

# %% tags=["wrong", "untrained", "nothing trained"]
prediction = "lingers"
hacked = learn_wrong_reward

# %% tags=["lucky", "all of them"]
prediction = ["touches", "lingers", "falls"]
hacked = learn_wrong_reward()

# %% tags=["lucky", "another character"]
prediction = "dancer"
hacked = learn_wrong_reward()

# %% tags=["lucky", "a number"]
prediction = 1
hacked = learn_wrong_reward()
