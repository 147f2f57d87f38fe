# %% tags=["solution"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    ball_is_nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if ball_is_nearer and lined_up(ball, place):
        angle = math.atan2(ball[1], ball[0])
        side = 1.2 if place[0] * ball[1] < place[1] * ball[0] else -1.2
        return go_to(math.cos(angle + side), math.sin(angle + side))  # past the ball
    return go_to(place[0], place[1])


# %% tags=["right", "a point beside the ball"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    away = math.hypot(ball[0], ball[1])
    if away < math.hypot(place[0], place[1]) and lined_up(ball, place):
        x, y = ball[0] / away, ball[1] / away
        side = 2.5 * METRE * (1 if place[0] * ball[1] < place[1] * ball[0] else -1)
        return go_to(ball[0] - side * y, ball[1] + side * x)
    return go_to(place[0], place[1])


# %% tags=["right", "keeps its distance"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    x, y = place[0], place[1]
    away = math.hypot(ball[0], ball[1])
    if away < 1.6 * METRE:  # too near: away from it, and around
        x, y = x - 0.08 * ball[0] / away, y - 0.08 * ball[1] / away
    difference = math.atan2(ball[1], ball[0]) - math.atan2(y, x)
    if away < math.hypot(x, y) and abs(math.remainder(difference, math.tau)) < 0.8:
        return go_to(-ball[1], ball[0])
    return go_to(x, y)


# %% tags=["wrong", "pushes", "straight to the place"]
def get_behind(percept):
    place = behind(percept["ball"], percept["goal"])
    return go_to(place[0], place[1])


# %% tags=["wrong", "pushes", "at the ball"]
def get_behind(percept):
    ball = percept["ball"]
    return go_to(ball[0], ball[1])


# %% tags=["wrong", "elsewhere", "to the goal"]
def get_behind(percept):
    goal = percept["goal"]
    return go_to(goal[0], goal[1])


# %% tags=["wrong", "elsewhere", "before the ball"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal, -2 * METRE)
    return go_to(place[0], place[1])


# %% tags=["wrong", "elsewhere", "home"]
def get_behind(percept):
    home = percept["home"]
    return go_to(home[0], home[1])


# %% tags=["wrong", "crawls", "at a crawl"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    away = math.hypot(ball[0], ball[1])
    if away < math.hypot(place[0], place[1]) and lined_up(ball, place):
        place = (-ball[1], ball[0])
    forward, turn, _, _ = go_to(place[0], place[1])["move"]
    return {"move": [0.15 * forward, turn, 0, 0]}


# %% tags=["wrong", "elsewhere", "waits for the ball to go"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    if lined_up(ball, place):
        return {"move": [0, 0, 0, 0]}
    return go_to(place[0], place[1])


# %% tags=["lucky", "circles"]
def get_behind(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "backward"]
def get_behind(percept):
    return {"move": [-1, 0, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def get_behind(percept):
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}
