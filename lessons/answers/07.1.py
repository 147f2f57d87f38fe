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
