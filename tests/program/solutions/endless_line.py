"""Steers by where the line is under its row of eyes; goes straight on over gaps, then turns."""

left = 0.0
lost = 0


def decide(percept):
    global left, lost
    eyes = percept["line"]
    if eyes.any():
        lost = 0
        if not eyes.all():  # as at a crossing
            left = sum(a * b for a, b in zip(eyes, [1, 0.5, 0, -0.5, -1])) / eyes.sum()
            return {"move": [0.5 - 0.45 * left, 0.5 + 0.45 * left]}
        return {"move": [0.5, 0.5]}
    lost += 1
    if lost <= 12 and abs(left) < 0.6:
        return {"move": [0.5, 0.5]}
    turn = 0.35 if left >= 0 else -0.35
    return {"move": [-turn, turn]}
