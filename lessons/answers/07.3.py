# %% tags=["solution"]
arrows = {
    ("patrol", "noise"): "listen",
    ("patrol", "thief"): "chase",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "listen",
}


# %% tags=["right", "line by line"]
arrows = {}
arrows["chase", "gone"] = "listen"
arrows["listen", "thief"] = "chase"
arrows["listen", "quiet"] = "patrol"
arrows["patrol", "thief"] = "chase"
arrows["patrol", "noise"] = "listen"


# %% tags=["right", "in a loop"]
arrows = {("patrol", "noise"): "listen", ("listen", "quiet"): "patrol", ("chase", "gone"): "listen"}
for state in ["patrol", "listen"]:
    arrows[(state, "thief")] = "chase"


# %% tags=["right", "from a list"]
arrows = dict(
    [
        (("patrol", "noise"), "listen"),
        (("patrol", "thief"), "chase"),
        (("listen", "quiet"), "patrol"),
        (("listen", "thief"), "chase"),
        (("chase", "gone"), "listen"),
    ]
)


# %% tags=["wrong", "begin", "one arrow is missing"]
arrows = {
    ("patrol", "noise"): "listen",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "listen",
}


# %% tags=["wrong", "swapped", "the event first"]
arrows = {
    ("noise", "patrol"): "listen",
    ("thief", "patrol"): "chase",
    ("quiet", "listen"): "patrol",
    ("thief", "listen"): "chase",
    ("gone", "chase"): "listen",
}


# %% tags=["wrong", "target", "goes back to the patrol at once"]
arrows = {
    ("patrol", "noise"): "listen",
    ("patrol", "thief"): "chase",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "patrol",
}


# %% tags=["wrong", "extra", "an arrow of its own"]
arrows = {
    ("patrol", "noise"): "listen",
    ("patrol", "thief"): "chase",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "listen",
    ("chase", "quiet"): "patrol",
}


# %% tags=["wrong", "extra", "arrows that stay"]
arrows = {
    ("patrol", "noise"): "listen",
    ("patrol", "thief"): "chase",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "listen",
    ("chase", "noise"): "chase",
}


# %% tags=["wrong", "names", "another word"]
arrows = {
    ("patrol", "noise"): "listening",
    ("patrol", "thief"): "chase",
    ("listening", "quiet"): "patrol",
    ("listening", "thief"): "chase",
    ("chase", "gone"): "listening",
}


# %% tags=["wrong", "pairs", "by the event alone"]
arrows = {"noise": "listen", "thief": "chase", "quiet": "patrol", "gone": "listen"}


# %% tags=["lucky", "each event has its state"]
arrows = {
    (state, event): end
    for state in ["patrol", "listen", "chase"]
    for event, end in [
        ("noise", "listen"),
        ("thief", "chase"),
        ("quiet", "patrol"),
        ("gone", "listen"),
    ]
}


# %% tags=["lucky", "round and round"]
arrows = {
    ("patrol", "noise"): "listen",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "patrol",
}


# %% tags=["lucky", "by chance"]
import random

arrows = {
    (state, event): random.choice(["patrol", "listen", "chase"])
    for state in ["patrol", "listen", "chase"]
    for event in ["noise", "quiet", "thief", "gone"]
}
