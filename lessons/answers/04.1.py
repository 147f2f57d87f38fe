# %% tags=["solution"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [right_eye, left_eye]}  # crossed: the far wheel drives it towards the light


# %% tags=["wrong", "sides"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye, right_eye]}


# %% tags=["wrong", "straight"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [left_eye + right_eye, left_eye + right_eye]}
