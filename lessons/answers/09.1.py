# %% tags=["solution"]
winners = {
    "near": "lingerer",  # being near pays again and again; the touch ends that
    "quick": "jumper",  # nothing else ends the costs
    "closer": "dancer",  # it comes closer again and again
}

# %% tags=["wrong", "near"]
winners = {
    "near": "runner",
    "quick": "jumper",
    "closer": "dancer",
}

# %% tags=["wrong", "closer"]
winners = {
    "near": "lingerer",
    "quick": "jumper",
    "closer": "lingerer",
}

# %% tags=["wrong", "quick"]
winners = {
    "near": "lingerer",
    "quick": "runner",
    "closer": "dancer",
}


# %% tags=["right", "made step by step"]
winners = {}
winners["near"] = "lingerer"
winners["quick"] = "jumper"
winners["closer"] = "dancer"


# %% tags=["right", "by trying"]
winners = {}
for name, rewards in well_meant.items():
    found = contest(rewards())
    winners[name] = max(found, key=found.get)


# %% tags=["wrong", "near", "near and closer swapped"]
winners = {"near": "dancer", "quick": "jumper", "closer": "lingerer"}


# %% tags=["wrong", "quick", "nobody falls willingly"]
winners = {"near": "lingerer", "quick": "sleeper", "closer": "dancer"}


# %% tags=["wrong", "name", "a name that there is not"]
winners = {"near": "winner", "quick": "jumper", "closer": "dancer"}


# %% tags=["wrong", "closer", "the runner comes closer fastest"]
winners = {"near": "lingerer", "quick": "jumper", "closer": "runner"}


# %% tags=["lucky", "always the runner"]
winners = {"near": "runner", "quick": "runner", "closer": "runner"}


# %% tags=["lucky", "always the lingerer"]
winners = {"near": "lingerer", "quick": "lingerer", "closer": "lingerer"}


# %% tags=["lucky", "one reward only"]
well_meant = {"near": well_meant["near"]}
winners = {"near": "lingerer"}


# %% tags=["lucky", "easier rewards"]
well_meant = dict.fromkeys(
    well_meant, lambda: [TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)]
)
winners = dict.fromkeys(well_meant, "runner")
