"""Calls while the partner faces its flag, and drives ahead while it is called."""


def decide(percept):
    call = percept["partner"][0] > 0.97
    if percept["goal"][0] > 0:
        move = [0.3, 0, 0, 0]  # stay in touch with the flag
    elif percept["hear"][0] > 0:
        move = [1, 0, 0, 0]
    else:
        move = [0, -0.5, 0, 0]
    return {"move": move, "speak": [call]}
