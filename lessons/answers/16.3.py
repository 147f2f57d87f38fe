# %% tags=["solution"]
def better(play, one, other):
    ahead = 0
    for seed in range(30):  # the same games for both
        ahead += play(one, seed) - play(other, seed)
    return one if ahead > 0 else other


# %% tags=["right", "two sums"]
def better(play, one, other):
    points = {player: sum(play(player, seed) for seed in range(50)) for player in (one, other)}
    return max(points, key=points.get)


# %% tags=["right", "games won"]
def better(play, one, other):
    won = sum(play(one, seed) > play(other, seed) for seed in range(100))
    return one if won > 50 else other


# %% tags=["right", "means with numpy"]
import numpy as np


def better(play, one, other):
    seeds = [7 * n for n in range(40)]
    mine = np.mean([play(one, seed) for seed in seeds])
    theirs = np.mean([play(other, seed) for seed in seeds])
    return one if mine > theirs else other


# %% tags=["wrong", "few", "one game"]
def better(play, one, other):
    return one if play(one, 0) > play(other, 0) else other


# %% tags=["wrong", "few", "until somebody wins twice"]
def better(play, one, other):
    wins = 0
    for seed in range(100):
        wins += 1 if play(one, seed) > play(other, seed) else -1
        if abs(wins) == 2:
            break
    return one if wins > 0 else other


# %% tags=["wrong", "seeds", "each plays other games"]
def better(play, one, other):
    mine = sum(play(one, seed) for seed in range(20))
    theirs = sum(play(other, seed) for seed in range(20, 40))
    return one if mine > theirs else other


# %% tags=["wrong", "seeds", "seeds by chance"]
import random


def better(play, one, other):
    mine = sum(play(one, random.randrange(10**6)) for _ in range(20))
    theirs = sum(play(other, random.randrange(10**6)) for _ in range(20))
    return one if mine > theirs else other


# %% tags=["wrong", "best", "the best game"]
def better(play, one, other):
    seeds = range(30)
    mine, theirs = (max(play(player, seed) for seed in seeds) for player in (one, other))
    return one if mine > theirs else other


# %% tags=["wrong", "reversed", "the other way round"]
def better(play, one, other):
    ahead = sum(play(one, seed) - play(other, seed) for seed in range(30))
    return other if ahead > 0 else one


# %% tags=["wrong", "name", "in quotes"]
def better(play, one, other):
    ahead = sum(play(one, seed) - play(other, seed) for seed in range(30))
    return "one" if ahead > 0 else "other"


# %% tags=["lucky", "the first one"]
def better(play, one, other):
    return one


# %% tags=["lucky", "plays, and takes the first one"]
def better(play, one, other):
    for seed in range(20):
        play(one, seed)
        play(other, seed)
    return one


# %% tags=["lucky", "tosses a coin"]
import random


def better(play, one, other):
    for seed in range(20):
        play(one, seed), play(other, seed)
    return random.choice([one, other])
