"""Turns to the target and pushes on, through boxes if need be."""

import math


def decide(percept):
    sine, cosine = percept["bearing"]
    turn = max(-1, min(1, -2 * math.atan2(sine, cosine)))
    return {"move": [max(cosine, 0.0), turn]}
