"""Programs for scenes of the library, as a beginner writes them: no numpy."""

BOX_CHASE = """
def decide(percept):
    cosine = percept["orientation"][0]
    if cosine > 0.99:
        return {"move": [1.0, 0, 0, 0]}
    return {"move": [0, 0.2, 0, 0]}
"""
LINE_FOLLOW = """
left = 0.0

def decide(percept):
    global left
    eyes = percept["line"]
    if eyes.any():
        left = sum(a * b for a, b in zip(eyes, [1, 0.5, 0, -0.5, -1])) / eyes.sum()
        return {"move": [0.7 - 0.5 * left, 0.7 + 0.5 * left]}
    turn = 0.4 if left >= 0 else -0.4
    return {"move": [-turn, turn]}
"""
MAZE = """
import math
from ai4u_edu import Controller

class Explorer(Controller):
    '''Keeps a wall at its right hand; goes for the exit when it sees it.'''
    distance: float = 0.8

    def on_reset(self, agent, view):
        self.seen = 0

    def get_action(self, percept):
        codes, far = percept["vision"][::2], percept["vision"][1::2] * 12
        exits = [math.radians(15 * ray - 90) for ray, code in enumerate(codes) if code == 1.0]
        if exits:
            self.seen += 1
            angle = sum(exits) / len(exits)
            angle = math.atan2(math.sin(angle), math.cos(angle))
            ahead = 1.0 if math.cos(angle) > 0.9 else 0
            return {"move": [ahead, max(-1, min(1, -2 * angle)), 0, 0]}
        if far[5:8].min() < 0.85:
            return {"move": [0, -1, 0, 0]}
        right = max(-1.0, min(1.0, far[:5].min() - self.distance))
        return {"move": [0.8 - 0.4 * abs(right), right, 0, 0]}
"""
GRID_WORLD = """
from collections import deque
STEPS = {1: (0, 1), 2: (0, -1), 3: (-1, 0), 4: (1, 0)}

def decide(percept):
    grid, cell = percept["grid"], tuple(percept["cell"])
    border, seen = deque([(cell, 0)]), {cell}
    while border:
        (row, column), first = border.popleft()
        if grid[row, column] == 200:
            return {"move": first}
        for choice, (down, right) in STEPS.items():
            there = row + down, column + right
            if there not in seen and grid[there] in (1, 200):
                seen.add(there)
                border.append((there, first or choice))
    return {"move": 0}
"""
JUMPER = """
import math

def decide(percept):
    x, y = percept["position"][:2] * 35.0
    sine, cosine = percept["heading"]
    wanted = math.atan2(-y, 4.0) - math.atan2(sine, cosine)
    edge = (x + 2) % 7 > 3.3 and x < 27
    leap = 1.0 if edge and abs(wanted) < 0.3 else 0
    angle = math.atan2(math.sin(wanted), math.cos(wanted))
    return {"move": [1.0 if math.cos(wanted) > 0.9 else 0, max(-1, min(1, -2 * angle)), 0, leap]}
"""
SCENES = {
    "box_chase": BOX_CHASE,
    "line_follow": LINE_FOLLOW,
    "maze": MAZE,
    "grid_world": GRID_WORLD,
    "jumper": JUMPER,
}
"""Program by the name of the scene that it solves."""
