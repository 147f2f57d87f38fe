"""Steers by where the line is under its row of eyes; off the line, to where it was last seen."""

left = 0.0


def decide(percept):
    global left
    eyes = percept["line"]
    if eyes.any():
        left = sum(a * b for a, b in zip(eyes, [1, 0.5, 0, -0.5, -1])) / eyes.sum()
        return {"move": [0.7 - 0.5 * left, 0.7 + 0.5 * left]}
    turn = 0.4 if left >= 0 else -0.4
    return {"move": [-turn, turn]}
