# %% [markdown]
# # 16 Several agents: tag and sumo
#
# ![The way of a chaser that caught three runners](pictures/16.png)
#
# A wall does not mind what you do. Another agent does: it runs away, it blocks your way, it pushes you
# out of the ring. How do you decide well if others decide as well?
#
# **When you have finished, you can**
#
# - tell from a scene who the agents are, what each senses, and what each wants,
# - write a controller that reacts to another agent,
# - say what a zero-sum game is,
# - let two controllers compete in a fair way.
#
# *About 60 minutes. Before: lesson 06.*
#
# **Recap.** A controller turns a percept into an action. Rules have priorities; some tasks need a memory.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.lessons import (
    bars,
    check,
    compare,
    film,
    hint,
    predict,
    progress,
    report,
    show,
    solution,
)
from ai4u_edu.lessons.exercises.lesson_16 import fights_won
from ai4u_edu.lessons.rollouts import drives


def go_to(forward, left):
    """Drives towards a place: so far ahead of the robot, so far to its left."""
    angle = math.atan2(left, forward)
    return {"move": [1 if abs(angle) < 0.5 else 0, max(-1, min(1, -2 * angle)), 0, 0]}


# %% [markdown]
# ## Who is there?
#
# In `tag` one agent chases and three run. You are the chaser. Play a round, and look at the others by
# clicking on them: the panel shows what *they* sense.

# %%
show("tag", seed=3)

# %%
sim = Scene.load("tag").build()
sim.reset(seed=3)
for agent in sim.agents:
    print(agent.id, "-", agent.brain.controller.__class__.__name__)
print()
for name, reading in sim.agents[0].percept.items():
    print(f"{name:10}", reading if isinstance(reading, (bool, str)) else reading.round(2))

# %% [markdown]
# The chaser senses where each runner is, **from its own point of view**: how far ahead, how far to the
# left (the third number is the height). The numbers are shares of the yard's size. `free` says who has
# not been caught yet: 1 or 0, in the order of the runners.
#
# ### Exercise 16.1: the chaser
#
# Catch all three within the time. Chase one that is still free, and don't stay for two seconds where you
# have just caught somebody. Which one is the best choice? The runners flee, but they are slower than you.


# %% tags=["exercise-16.1"]
def chase(percept):
    forward, left, height = percept["runner 1"]
    return go_to(forward, left)


# %%
check("16.1", chase)

# %% [markdown]
# ## One against one
#
# In `sumo` two robots stand in a ring. The first to fall out has lost. What one wins, the other loses:
# that is called a *zero-sum game*. The orange one charges at you. You sense where it is (`opponent`:
# ahead, left), where you are in the ring (`position`, the middle is 0, 0), and which way you face
# (`heading`: sine, cosine).


# %% tags=["setup"]
RING = 4 / 9
"""The ring's radius, in the unit of ``position``."""


def to_the_middle(percept):
    """The middle of the ring, seen from the robot: ahead, left."""
    x, y = percept["position"][0], percept["position"][1]
    sine, cosine = percept["heading"]
    return -x * cosine - y * sine, x * sine - y * cosine


# %% [markdown]
# ### Exercise 16.2: stay in the ring
#
# Win at least 17 of 20 fights. Here are two plans:
#
# - *Attack*: always drive at the opponent.
# - *Be careful*: near the edge, go to the middle first; else attack. `to_the_middle(percept)` says where
#   the middle is.
#
# Which one sounds wiser? In how many of 20 fights does each of them win? Write down your guess (*attack*
# first), then try both: the check runs the same twenty fights for each plan.

# %%
predict("16.fights", [..., ...])


# %% tags=["exercise-16.2"]
def fight(percept):
    return {"move": [1, 0, 0, 0]}


# %%
check("16.2", fight)

# %%
film("sumo", fight, seed=2)

# %% [markdown]
# Now the two plans. Both fight twenty times, and the seeds are the same for both.

# %%
compare("16.fights", [fights_won("attack"), fights_won("careful")])

# %% [markdown]
# What sounds wise does not always win. The numbers decide. But which numbers?
#
# ## A fair contest
#
# Who is the better chaser? One game says little: chance decides too. And some games are easier than
# others, whoever plays. So let both play the **same** games (the same seeds), many of them, and compare.
#
# ### Exercise 16.3: a fair contest
#
# `play(player, seed)` plays one game, and returns the player's points. Return the better one of the two
# players, `one` or `other`. The check gives you thirty pairs of players of a game that you do not know.
# Chance plays a part in it, and some seeds are hard for everybody.


# %% tags=["exercise-16.3"]
def better(play, one, other):
    return one if play(one, 0) > play(other, 1) else other


# %%
check("16.3", better)

# %% [markdown]
# And now your own chaser, against one that does not look:


# %%
def caught(controller, seed):
    """Return the number of runners that a chaser catches in one game of tag."""
    (game,) = drives("tag", controller, [seed])
    return 3 - sum(game.agent.percept["free"])


def lazy(percept):
    return {"move": [0.5, 0.3, 0, 0]}


print("better:", better(caught, chase, lazy).__name__)

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** Which of these is a zero-sum game?
#
# - a: Two robots carry a table that is too heavy for one.
# - b: Two robots fight, and one of them wins.
# - c: A test in which everybody can get full marks.
#
# **2.** Ann wins 3 of the 5 games with seeds 0 to 4. Ben wins 4 of the 5 games with seeds 5 to 9. Who is
# the better player?
#
# - a: Ben: 4 is more than 3.
# - b: They are about equal: 3 and 4 of 5 are close.
# - c: You can't say: the games were few, and not the same.
#
# **3.** The careful plan sounds wiser, and wins fewer fights. What do you conclude?
#
# - a: Against this opponent, attacking is the better plan.
# - b: Being careful is never a good plan.
# - c: Something is wrong with the count.

# %% tags=["exercise-16.exit"]
answers = ["", "", ""]

# %%
check("16.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Swap the sides: be a runner. `sim.agent("runner_1").use_brain(...)`. It senses `pursuer` and rays.
# - Hold a championship in your class: everybody hands in a `fight` function, and all fight each other on
#   the same seeds. (The orange robot is the agent `"orange"`.)
# - With how few games does your `better` still name the right one every time?
#
# **Words of this lesson:** multi-agent, zero-sum game, opponent, contest. **Next:** 17: a team, and a ball.
