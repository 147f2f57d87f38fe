# %% tags=["solution"]
def strike(percept):
    ball, goal = percept["ball"][:2], percept["goal"][:2]
    shot = minus(goal, ball)
    shot = times(1 / length(shot), shot)  # the direction of the shot, of length 1
    metre = 1 / (math.hypot(16.2, 9.2) + 5)
    ahead = ball[0] * shot[0] + ball[1] * shot[1]  # how far the ball is, along the shot
    aside = ball[1] * shot[0] - ball[0] * shot[1]  # and to the side of it
    near = ahead < metre
    if ahead > 0 and abs(aside) < (1.2 if near else 0.4) * ahead:
        place = plus(ball, times(0.3 * metre, shot))  # behind it: through the ball
    elif ahead > 0:
        place = minus(ball, times(1.2 * metre, shot))
    else:  # in front of it: around the ball
        side = 1 if aside < 0 else -1
        way_round = times(1.2 * metre * side, (-shot[1], shot[0]))
        place = plus(minus(ball, times(metre, shot)), way_round)
    return go_to(place[0], place[1])


# %% tags=["wrong", "begin"]
def strike(percept):
    home = percept["home"]
    return go_to(home[0], home[1])
