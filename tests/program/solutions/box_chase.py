"""Turns until the box is ahead, and drives."""


def decide(percept):
    cosine = percept["orientation"][0]
    if cosine > 0.99:
        return {"move": [1.0, 0, 0, 0]}
    return {"move": [0, 0.2, 0, 0]}
