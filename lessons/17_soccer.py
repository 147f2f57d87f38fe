# %% [markdown]
# # 17 Soccer: behind the ball
#
# ![The way of a striker around the ball, and the goal](pictures/17.png)
#
# If you run straight at a ball, it flies off the way you were running. So a striker does not think "where
# is the ball?" but "where do I have to stand?" In this lesson you build a striker in three small steps,
# and let it play.
#
# **When you have finished, you can**
#
# - say who cooperates in a game, and who are opponents,
# - compare two directions, also across the back,
# - compute a place from two others,
# - build a controller out of small functions that you have tested.
#
# *About 60 minutes without the gold exercise. Before: lesson 16.*
#
# **Recap.** Other agents decide too. A contest is fair if both play the same games, many of them.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.lessons import check, compare, film, hint, predict, progress, report, show, solution
from ai4u_edu.lessons.exercises.lesson_17 import (
    METRE,
    behind,
    go_to,
    goals,
    lined_up,
    practice,
)

# %% [markdown]
# ## A team
#
# In `soccer` you are the blue striker; a keeper of your own team stands behind you. What you win, your
# keeper wins too: you **cooperate**. The two orange ones are your opponents. Play a round:

# %%
show("soccer", seed=1)

# %% [markdown]
# You sense `ball`, `goal` (theirs) and `home` (yours), each as [ahead, left, height] seen from you. The
# numbers are shares of the pitch's size: a metre is `METRE`, about 0.04.

# %%
sim = Scene.load("soccer").build()
sim.reset(seed=1)
for name in ("ball", "goal", "home"):
    ahead, left, height = sim.agents[0].percept[name] / METRE
    print(f"{name}: {ahead:.1f} m ahead, {left:.1f} m to the left")

# %% [markdown]
# In the games of this lesson you begin on the wrong side: between the ball and their goal. How many of 12
# games will a striker win that always runs straight at the ball?

# %%
predict("17.straight", ...)


# %%
def straight(percept):
    return go_to(percept["ball"][0], percept["ball"][1])


compare("17.straight", goals(straight))

# %% [markdown]
# It wins by luck, when the ball comes off a wall the right way.
#
# ## Step 1: is the ball in line with the goal?
#
# If ball and goal lie in the same direction, you may run: the ball will fly towards the goal.
# `math.atan2(left, ahead)` is the direction to a place, in radians: 0 is straight ahead, above 0 is to
# the left, 3.14 and -3.14 are both straight behind.
#
# ### Exercise 17.1: the same direction
#
# Return True if the directions to `ball` and `goal` differ by less than 0.5 radians (29 degrees), else
# False.


# %% tags=["exercise-17.1"]
def same_way(ball, goal):
    return False


# %%
check("17.1", same_way)

# %% [markdown]
# ## Step 2: the place behind the ball
#
# Draw the line from the goal through the ball, and go on a bit: there you should stand. Draw it on paper,
# with the ball at (2, 1) and the goal at (6, 4). The way from the ball to the goal is (4, 3). How long is
# it? One metre of this way is (4, 3) divided by its length. So where is the place that is 2 metres behind
# the ball?
#
# ### Exercise 17.2: behind the ball
#
# Return the place [ahead, left] that lies `gap` behind the ball, seen from the goal. `ball` and `goal`
# are lists of three numbers; the third one is the height, and does not matter.


# %% tags=["exercise-17.2"]
def place_behind(ball, goal, gap):
    return [0, 0]


# %%
check("17.2", place_behind)

# %% [markdown]
# From here on you can use `lined_up(ball, goal)` and `behind(ball, goal)`, which do the same as your two
# functions; the gap is 1.4 metres. `go_to(ahead, left)` drives towards a place, as in lesson 16.
#
# ## Step 3: go there, but not through the ball
#
# You stand in front of the ball, so the way to the place behind it leads right through the ball. When the
# ball is in the way, go past it first. The pitch is empty: no opponents yet.
#
# ### Exercise 17.3: around the ball
#
# Get behind the ball in at least 8 of 10 worlds, and don't push it away. When is the ball in the way?
# When it lies in the same direction as the place (`lined_up(ball, place)`), and is nearer than the place
# (`math.hypot(ahead, left)` is a distance). Then go to a point at the side of the ball.


# %% tags=["exercise-17.3"]
def get_behind(percept):
    ball, goal = percept["ball"], percept["goal"]
    place = behind(ball, goal)
    return go_to(ball[0], ball[1])


# %%
check("17.3", get_behind)

# %%
film(practice(), get_behind, seed=2, limit=100)

# %% [markdown]
# ## The striker
#
# Now put it together: when ball and goal lie in the same direction, run through the ball. If not, get
# behind it.
#
# ### Exercise 17.4: the striker
#
# Score in at least 9 of 12 games against the orange team. You begin between the ball and their goal.


# %% tags=["exercise-17.4"]
def strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    return go_to(ball[0], ball[1])


# %%
check("17.4", strike)

# %%
film("soccer", strike, seed=4, limit=400)

# %% [markdown]
# Three functions of a few lines, each of them tested alone, and a fourth that chooses. If it goes wrong,
# you know where to look. That is how engineers build robots, too.

# %% [markdown]
# ### Exercise 17.5: gold: quick goals
#
# *For fast finishers; optional.* With our `go_to`, half of the goals come within 10 seconds (120
# decisions). Score that quickly in at least **16 of 24** games.


# %% tags=["exercise-17.5"]
def quick_strike(percept):
    ball, goal = percept["ball"], percept["goal"]
    return go_to(ball[0], ball[1])


# %%
check("17.5", quick_strike)

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** Your robot stands between the ball and the opponents' goal. It runs straight at the ball. Where
# does the ball go?
#
# - a: Towards its own goal.
# - b: Towards the opponents' goal.
# - c: To the side, past the robot.
#
# **2.** One thing lies in the direction 3.1 radians, another one in the direction -3.1. How do the two
# directions differ?
#
# - a: They are opposite: one is ahead, the other is behind.
# - b: One is far on the left, the other far on the right.
# - c: Hardly: both are nearly straight behind.
#
# **3.** Why did you write and test three small functions before the striker?
#
# - a: Because small functions are computed faster.
# - b: Because then you know which part is wrong if the striker fails.
# - c: Because a controller can't be longer than a few lines.

# %% tags=["exercise-17.exit"]
answers = ["", "", ""]

# %%
check("17.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Two blue players who both run at the ball get in each other's way. Write a keeper that stays between
#   ball and home, and passes: `sim.agent("blue_keeper").use_brain(...)`.
# - Let `sim.agent("orange_striker")` play your `strike` too. Its `goal` is the blue one, so the same
#   lines work. Who wins?
# - The ball rolls on while you drive. Aim at where it will be, not at where it is. Does it help?
#
# **Words of this lesson:** team, to cooperate, direction, line up. **Next:** 18, in which a creature
# gets hungry.
