# %% tags=["solution"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 2.5 * left_eye, 1 - 2.5 * right_eye]}


# %% tags=["wrong", "sides"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 2.5 * right_eye, 1 - 2.5 * left_eye]}


# %% tags=["wrong", "weak"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - left_eye, 1 - right_eye]}


# %% tags=["wrong", "strong"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [1 - 6 * left_eye, 1 - 6 * right_eye]}
