"""Steers towards the middle of the floor that it sees a bit ahead."""


def decide(percept):
    floor = percept["vision"][0, 1]  # 18 degrees down: 1.5 m ahead; column 0 is the leftmost
    last = len(floor) - 1
    sides = [2 * column / last - 1 for column in range(last + 1)]
    right = sum(seen * side for seen, side in zip(floor, sides)) / max(floor.sum(), 1.0)
    return {"move": [0.9, max(-1, min(1, 2 * right)), 0, 0]}
