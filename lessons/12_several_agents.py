# %% [markdown]
# # 12 Several agents: tag, sumo, soccer
#
# ![The way of a chaser that caught three runners](pictures/12.png)
#
# A wall does not mind what you do. Another agent does: it runs away, it blocks your way, it passes you the
# ball. How do you decide well if others decide as well?
#
# **When you have finished, you can**
#
# - tell from a scene who the agents are, what each senses, and what each wants,
# - write a controller that reacts to another agent,
# - say whose interests are the same, and whose are opposed,
# - let two controllers compete in a fair way.
#
# *About 90 minutes. Before: lesson 05.*
#
# **Recap.** A controller turns a percept into an action. Rules have priorities; some tasks need a memory.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.lessons import bars, check, film, hint, progress, report, show, solution


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
# ### Exercise 12.1: the chaser
#
# Catch all three within the time. Chase one that is still free. Which one is the best choice? The runners
# flee, but they are slower than you.


# %% tags=["exercise-12.1"]
def chase(percept):
    forward, left, height = percept["runner 1"]
    return go_to(forward, left)


# %%
check("12.1", chase)

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
# ### Exercise 12.2: stay in the ring
#
# Win at least 17 of 20 fights. Here are two plans:
#
# - *Attack*: always drive at the opponent.
# - *Be careful*: near the edge, go to the middle first; else attack. `to_the_middle(percept)` says where
#   the middle is.
#
# Which one sounds wiser? Write down your guess. Then try both: the check lets each fight the same twenty
# fights, and it is the number that counts, not what sounds wise.


# %% tags=["exercise-12.2"]
def fight(percept):
    return {"move": [1, 0, 0, 0]}


# %%
check("12.2", fight)

# %%
film("sumo", fight, seed=2)

# %% [markdown]
# ## A team
#
# In `soccer` you are the blue striker; a keeper of your own team stands behind you. What you win, your
# keeper wins too: you *cooperate*. The others are your opponents.
#
# You sense `ball`, `goal` (theirs) and `home` (yours), each as [ahead, left, height] seen from you. Play a
# round before you write:

# %%
show("soccer", seed=1)

# %% [markdown]
# ### Exercise 12.3: the striker
#
# The game begins, and you stand on the wrong side: between the ball and their goal. Score in at least 6
# of 12 such games. If you run at the ball, it flies off the way you were running. So where do you have to
# be before you run at it? Think of the line from the ball to the goal: **behind** the ball, seen from the
# goal. `behind(ball, goal)` is that place.


# %% tags=["setup"]
def behind(ball, goal, gap=0.06):
    """The place behind the ball, seen from the goal; ``gap`` is its distance from the ball."""
    x, y = goal[0] - ball[0], goal[1] - ball[1]
    length = math.hypot(x, y)
    return ball[0] - gap * x / length, ball[1] - gap * y / length


# %% tags=["exercise-12.3"]
def strike(percept):
    ball = percept["ball"]
    goal = percept["goal"]
    return go_to(ball[0], ball[1])


# %%
check("12.3", strike)

# %% [markdown]
# ## A fair contest
#
# Who is the better chaser? One game says little: chance decides too. Let both play the **same** twenty
# games (the same seeds), and count.


# %%
def caught(controller, seeds=range(5)):
    """How many runners a chaser catches on average."""
    total = 0
    for seed in seeds:
        sim = Scene.load("tag").build()
        chaser = sim.agent("chaser")
        chaser.use_brain(LocalBrain(controller=controller, skip_frame=chaser.brain.skip_frame))
        sim.reset(seed)
        while not chaser.done:
            sim.step(chaser)
        total += 3 - sum(chaser.percept["free"])
    return total / len(seeds)


def lazy(percept):
    return {"move": [0.5, 0.3, 0, 0]}


bars({"mine": caught(chase), "lazy": caught(lazy)}, ylabel="runners caught", title="tag")

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Swap the sides: be a runner. `sim.agent("runner_1").use_brain(...)`. It senses `pursuer` and rays.
# - Hold a championship in your class: each hands in a `fight` function, everybody fights against everybody
#   on the same seeds. (The orange robot is the agent `"orange"`.)
# - Two blue players who both run at the ball get in each other's way. Write a keeper that passes.
#
# **Words of this lesson:** multi-agent, zero-sum game, to cooperate, opponent, contest. **Next:** 13, in
# which a creature gets hungry.
