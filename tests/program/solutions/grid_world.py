"""Searches the map for a shortest way to a dirty place."""

from collections import deque

FLOOR, DIRTY = 1, 200
STEPS = {1: (0, 1), 2: (0, -1), 3: (-1, 0), 4: (1, 0)}


def decide(percept):
    grid, start = percept["grid"], tuple(percept["cell"])
    border, seen = deque([(start, 0)]), {start}
    while border:
        (row, column), first = border.popleft()
        if grid[row, column] == DIRTY:
            return {"move": first}
        for choice, (down, right) in STEPS.items():
            there = row + down, column + right
            if there not in seen and grid[there] in (FLOOR, DIRTY):
                seen.add(there)
                border.append((there, first or choice))
    return {"move": 0}
