"""Steers by where the line is under its eyes, slower in a bend; off it, to where it was last."""

left = 0.0


def decide(percept):
    global left
    eyes = percept["line"]
    if eyes.any():
        left = sum(a * b for a, b in zip(eyes, [1, 0.5, 0, -0.5, -1])) / eyes.sum()
        speed = 0.75 - 0.25 * abs(left)
        return {"move": [speed - 0.5 * left, speed + 0.5 * left]}
    turn = 0.4 if left >= 0 else -0.4
    return {"move": [-turn, turn]}
