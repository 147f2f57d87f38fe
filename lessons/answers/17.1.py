# %% tags=["solution"]
def same_way(ball, goal):
    to_ball, to_goal = math.atan2(ball[1], ball[0]), math.atan2(goal[1], goal[0])
    return abs(math.remainder(to_ball - to_goal, math.tau)) < 0.5


# %% tags=["right", "a scalar product"]
def same_way(ball, goal):
    product = ball[0] * goal[0] + ball[1] * goal[1]
    return product > math.cos(0.5) * math.hypot(ball[0], ball[1]) * math.hypot(goal[0], goal[1])


# %% tags=["right", "turns of the difference"]
def same_way(ball, goal):
    difference = abs(math.atan2(ball[1], ball[0]) - math.atan2(goal[1], goal[0]))
    return difference < 0.5 or difference > 2 * math.pi - 0.5


# %% tags=["right", "complex numbers"]
import cmath


def same_way(ball, goal):
    return abs(cmath.phase(complex(ball[0], ball[1]) / complex(goal[0], goal[1]))) < 0.5


# %% tags=["wrong", "begin", "never"]
def same_way(ball, goal):
    return False


# %% tags=["wrong", "wrap", "forgets the back"]
def same_way(ball, goal):
    return abs(math.atan2(ball[1], ball[0]) - math.atan2(goal[1], goal[0])) < 0.5


# %% tags=["wrong", "sign", "without abs"]
def same_way(ball, goal):
    to_ball, to_goal = math.atan2(ball[1], ball[0]), math.atan2(goal[1], goal[0])
    return math.remainder(to_ball - to_goal, math.tau) < 0.5


# %% tags=["wrong", "atan", "atan of a quotient"]
def same_way(ball, goal):
    return abs(math.atan(ball[1] / ball[0]) - math.atan(goal[1] / goal[0])) < 0.5


# %% tags=["wrong", "side", "the same side"]
def same_way(ball, goal):
    return (ball[1] > 0) == (goal[1] > 0)


# %% tags=["wrong", "near", "near to each other"]
def same_way(ball, goal):
    return math.dist(ball, goal) < 0.5


# %% tags=["wrong", "no-return", "no return"]
def same_way(ball, goal):
    abs(math.atan2(ball[1], ball[0]) - math.atan2(goal[1], goal[0])) < 0.5


# %% tags=["lucky", "always"]
def same_way(ball, goal):
    return True


# %% tags=["lucky", "both ahead"]
def same_way(ball, goal):
    return bool(ball[0] > 0 and goal[0] > 0)


# %% tags=["lucky", "tosses a coin"]
import random


def same_way(ball, goal):
    return random.random() < 0.5


# %% tags=["wrong", "wrap", "the other way round, and forgets the wrap"]
def same_way(ball, goal):
    return abs(math.atan2(ball[0], ball[1]) - math.atan2(goal[0], goal[1])) < 0.5


# %% tags=["wrong", "wrap", "the same in two steps"]
def same_way(ball, goal):
    to_ball = math.atan2(ball[0], ball[1])
    to_goal = math.atan2(goal[0], goal[1])
    difference = to_ball - to_goal
    return -0.5 < difference < 0.5


# %% tags=["wrong", "wrap", "the same in degrees"]
def same_way(ball, goal):
    first = math.degrees(math.atan2(ball[0], ball[1]))
    second = math.degrees(math.atan2(goal[0], goal[1]))
    return abs(first - second) < 28
