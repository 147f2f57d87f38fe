# %% tags=["solution"]
skip_frame = 18  # 19 ticks at 3 m/s are 0.95 m: a bit less than the feeler sees ahead

# %% tags=["wrong", "falls"]
skip_frame = 30

# %% tags=["wrong", "lazier"]
skip_frame = 10
