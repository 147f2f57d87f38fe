# %% tags=["solution"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye, right_eye]}  # the wheel on the bright side turns it away


# %% tags=["wrong", "sides"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [right_eye, left_eye]}


# %% tags=["wrong", "rest"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0.5 + left_eye, 0.5 + right_eye]}
