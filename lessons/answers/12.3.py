# %% tags=["solution"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    to_ball, to_goal = math.atan2(ball[1], ball[0]), math.atan2(goal[1], goal[0])
    if abs(math.remainder(to_ball - to_goal, math.tau)) < 0.5:
        return go_to(ball[0], ball[1])  # ball and goal lie in the same direction: through the ball
    place = behind(ball, goal)
    to_place = math.atan2(place[1], place[0])
    ball_is_nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if ball_is_nearer and abs(math.remainder(to_ball - to_place, math.tau)) < 0.6:
        side = 1.2 if math.remainder(to_place - to_ball, math.tau) > 0 else -1.2
        return go_to(math.cos(to_ball + side), math.sin(to_ball + side))  # past the ball
    return go_to(place[0], place[1])


# %% tags=["wrong", "begin", "defends"]
def strike(percept):
    home = percept["home"]
    return go_to(home[0], home[1])


# %% tags=["right", "lines up"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    to_ball, to_goal = math.atan2(ball[1], ball[0]), math.atan2(goal[1], goal[0])
    if abs(math.remainder(to_ball - to_goal, math.tau)) < 0.5:
        return go_to(ball[0], ball[1])
    return go_to(place[0], place[1])


# %% tags=["right", "remembers that it was there"]
was_there = False


def strike(percept):
    global was_there
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal, 0.1)
    if math.hypot(place[0], place[1]) < 0.03:
        was_there = True
    if math.hypot(ball[0], ball[1]) > 0.2:
        was_there = False
    return go_to(ball[0], ball[1]) if was_there else go_to(place[0], place[1])


# %% tags=["wrong", "begin", "runs at the ball"]
def strike(percept):
    ball = percept["ball"]
    return go_to(ball[0], ball[1])


# %% tags=["wrong", "begin", "waits behind it"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    if math.hypot(place[0], place[1]) < 0.02:
        return {"move": [0, 0, 0, 0]}
    return go_to(place[0], place[1])


# %% tags=["wrong", "begin", "runs at the goal"]
def strike(percept):
    goal = percept["goal"]
    return go_to(goal[0], goal[1])


# %% tags=["lucky", "straight on"]
def strike(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def strike(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def strike(percept):
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}
