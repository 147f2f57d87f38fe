# %% tags=["solution"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    if lined_up(ball, goal):
        return go_to(ball[0], ball[1])  # through the ball
    place = behind(ball, goal)
    ball_is_nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
    if ball_is_nearer and lined_up(ball, place):
        angle = math.atan2(ball[1], ball[0])
        side = 1.2 if place[0] * ball[1] < place[1] * ball[0] else -1.2
        return go_to(math.cos(angle + side), math.sin(angle + side))  # past the ball
    return go_to(place[0], place[1])


# %% tags=["right", "always past it on the left"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    if lined_up(ball, goal):
        return go_to(ball[0], ball[1])
    place = behind(ball, goal)
    away = math.hypot(ball[0], ball[1])
    if away < math.hypot(place[0], place[1]) and lined_up(ball, place):
        x, y = ball[0] / away, ball[1] / away
        return go_to(ball[0] - 1.6 * METRE * y, ball[1] + 1.6 * METRE * x)
    return go_to(place[0], place[1])


# %% tags=["right", "a state machine"]
class Striker(Controller):
    state: str = "around"

    def get_action(self, percept):
        ball, goal = percept["ball"], percept["goal"]
        self.state = "through" if lined_up(ball, goal) else "around"
        if self.state == "through":
            return go_to(ball[0], ball[1])
        place = behind(ball, goal)
        nearer = math.hypot(ball[0], ball[1]) < math.hypot(place[0], place[1])
        if nearer and lined_up(ball, place):
            angle = math.atan2(ball[1], ball[0])
            side = math.copysign(1.2, place[1] * ball[0] - place[0] * ball[1])
            return go_to(math.cos(angle + side), math.sin(angle + side))
        return go_to(place[0], place[1])


strike = Striker()


# %% tags=["wrong", "begin", "runs at the ball"]
def strike(percept):
    ball = percept["ball"]
    return go_to(ball[0], ball[1])


# %% tags=["wrong", "around", "pushes the ball on its way"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    if lined_up(ball, goal):
        return go_to(ball[0], ball[1])
    place = behind(ball, goal)
    return go_to(place[0], place[1])


# %% tags=["wrong", "through", "waits behind it"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    if lined_up(ball, goal):
        return {"move": [0, 0, 0, 0]}
    return go_to(place[0], place[1])


# %% tags=["wrong", "through", "defends"]
def strike(percept):
    home = percept["home"]
    return go_to(home[0], home[1])


# %% tags=["wrong", "unknown", "runs at the goal"]
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
