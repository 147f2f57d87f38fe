# %% tags=["solution"]
skip_frame = 18  # 19 ticks at 3 m/s are 0.95 m: a bit less than the feeler sees ahead

# %% tags=["wrong", "falls"]
skip_frame = 30

# %% tags=["wrong", "lazier"]
skip_frame = 10


# %% tags=["right", "a little less"]
skip_frame = 17


# %% tags=["right", "a whole float"]
skip_frame = 18.0


# %% tags=["right", "16"]
skip_frame = 16


# %% tags=["wrong", "whole", "not rounded"]
skip_frame = 0.98 / 3 * 60 - 1


# %% tags=["wrong", "falls", "one tick too many"]
skip_frame = 20


# %% tags=["wrong", "falls", "counts decisions for ticks"]
skip_frame = 60


# %% tags=["wrong", "not-a-number", "text"]
skip_frame = "18"


# %% tags=["lucky", "5"]
skip_frame = 5


# %% tags=["lucky", "none"]
skip_frame = 0


# %% tags=["lucky", "a thousand"]
skip_frame = 1000
