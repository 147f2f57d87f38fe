# %% tags=["solution"]
def place_behind(ball, goal, gap):
    x, y = goal[0] - ball[0], goal[1] - ball[1]  # from the ball to the goal
    length = math.hypot(x, y)
    return [ball[0] - gap * x / length, ball[1] - gap * y / length]


# %% tags=["right", "with an angle"]
def place_behind(ball, goal, gap):
    angle = math.atan2(goal[1] - ball[1], goal[0] - ball[0])
    return ball[0] - gap * math.cos(angle), ball[1] - gap * math.sin(angle)


# %% tags=["right", "from the goal on"]
def place_behind(ball, goal, gap):
    away = math.dist(ball[:2], goal[:2])
    share = (away + gap) / away
    return [g + share * (b - g) for b, g in zip(ball[:2], goal[:2])]


# %% tags=["right", "numpy"]
import numpy as np


def place_behind(ball, goal, gap):
    way = np.array(goal[:2]) - np.array(ball[:2])
    return np.array(ball[:2]) - gap * way / np.linalg.norm(way)


# %% tags=["wrong", "front", "before the ball"]
def place_behind(ball, goal, gap):
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return [ball[0] + gap * x / length, ball[1] + gap * y / length]


# %% tags=["wrong", "long", "does not divide by the length"]
def place_behind(ball, goal, gap):
    return [ball[0] - gap * (goal[0] - ball[0]), ball[1] - gap * (goal[1] - ball[1])]


# %% tags=["wrong", "robot", "behind it as the robot sees it"]
def place_behind(ball, goal, gap):
    away = math.hypot(ball[0], ball[1])
    return [ball[0] + gap * ball[0] / away, ball[1] + gap * ball[1] / away]


# %% tags=["wrong", "goal", "begins at the goal"]
def place_behind(ball, goal, gap):
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return [goal[0] - gap * x / length, goal[1] - gap * y / length]


# %% tags=["wrong", "swapped", "left before ahead"]
def place_behind(ball, goal, gap):
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return [ball[1] - gap * y / length, ball[0] - gap * x / length]


# %% tags=["wrong", "unknown", "to the left of the robot's world"]
def place_behind(ball, goal, gap):
    return [ball[0] - gap, ball[1]]


# %% tags=["lucky", "the ball itself"]
def place_behind(ball, goal, gap):
    return [ball[0], ball[1]]


# %% tags=["lucky", "the middle"]
def place_behind(ball, goal, gap):
    return [(ball[0] + goal[0]) / 2, (ball[1] + goal[1]) / 2]


# %% tags=["lucky", "zeros"]
def place_behind(ball, goal, gap):
    return [0, 0]
