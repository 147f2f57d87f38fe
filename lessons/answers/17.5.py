# %% tags=["solution"]
def drive_to(ahead, left):
    """Drives on while it turns, and turns faster than go_to."""
    angle = math.atan2(left, ahead)
    forward = 1 if abs(angle) < 0.8 else 0.3 * max(0, math.cos(angle))
    return {"move": [forward, max(-1, min(1, -3 * angle)), 0, 0]}


def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    if lined_up(ball, goal):
        return drive_to(ball[0], ball[1])
    place = behind(ball, goal, 1.0 * METRE)  # nearer to the ball
    to_ball, to_place = math.atan2(ball[1], ball[0]), math.atan2(place[1], place[0])
    is_in_the_way = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if is_in_the_way and abs(math.remainder(to_ball - to_place, math.tau)) < 0.5:
        side = 0.9 if math.remainder(to_place - to_ball, math.tau) > 0 else -0.9
        return drive_to(math.cos(to_ball + side), math.sin(to_ball + side))
    return drive_to(place[0], place[1])


# %% tags=["right", "passes it closely"]
def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]

    def there(x, y):
        angle = math.atan2(y, x)
        return {"move": [float(abs(angle) < 0.8), max(-1, min(1, -3 * angle)), 0, 0]}

    if lined_up(ball, goal):
        return there(ball[0], ball[1])
    place = behind(ball, goal, 1.1 * METRE)
    to_ball, to_place = math.atan2(ball[1], ball[0]), math.atan2(place[1], place[0])
    way = math.remainder(to_place - to_ball, math.tau)
    if math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1]) and abs(way) < 0.5:
        angle = to_ball + math.copysign(0.9, way)
        return there(math.cos(angle), math.sin(angle))
    return there(place[0], place[1])


# %% tags=["right", "a place nearer behind the ball"]
def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = ball if lined_up(ball, goal) else behind(ball, goal, 1.0 * METRE)
    angle = math.atan2(place[1], place[0])
    to_ball = math.atan2(ball[1], ball[0])
    difference = math.remainder(angle - to_ball, math.tau)
    if place is not ball and abs(difference) < 0.6 and math.hypot(*ball[:2]) < math.hypot(*place):
        angle = to_ball + (1.0 if difference > 0 else -1.0)
    angle = math.remainder(angle, math.tau)
    forward = 1 if abs(angle) < 0.8 else 0.3 * max(0, math.cos(angle))
    return {"move": [forward, max(-1, min(1, -3 * angle)), 0, 0]}


# %% tags=["wrong", "begin", "runs at the ball"]
def quick_strike(percept):
    ball = percept["ball"]
    return go_to(ball[0], ball[1])


# %% tags=["wrong", "turns", "as in 17.4"]
def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    if lined_up(ball, goal):
        return go_to(ball[0], ball[1])
    place = behind(ball, goal)
    nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if nearer and lined_up(ball, place):
        angle = math.atan2(ball[1], ball[0])
        side = 1.2 if place[0] * ball[1] < place[1] * ball[0] else -1.2
        return go_to(math.cos(angle + side), math.sin(angle + side))
    return go_to(place[0], place[1])


# %% tags=["wrong", "far", "far around the ball"]
def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]

    def there(x, y):
        angle = math.atan2(y, x)
        return {"move": [float(abs(angle) < 0.8), max(-1, min(1, -3 * angle)), 0, 0]}

    if lined_up(ball, goal):
        return there(ball[0], ball[1])
    place = behind(ball, goal, 2.2 * METRE)
    nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if nearer and lined_up(ball, place):
        angle = math.atan2(ball[1], ball[0])
        side = 1.4 if place[0] * ball[1] < place[1] * ball[0] else -1.4
        return there(math.cos(angle + side), math.sin(angle + side))
    return there(place[0], place[1])


# %% tags=["wrong", "begin", "only the place behind"]
def quick_strike(percept):
    place = behind(percept["ball"], percept["goal"])
    return go_to(place[0], place[1])


# %% tags=["wrong", "no-return", "no return"]
def quick_strike(percept):
    go_to(percept["ball"][0], percept["ball"][1])


# %% tags=["lucky", "straight on"]
def quick_strike(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
def quick_strike(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "by chance"]
import random


def quick_strike(percept):
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}
