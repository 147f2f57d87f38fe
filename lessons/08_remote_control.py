# %% [markdown]
# # 08 Remote control: your script, another machine
#
# ![A robot that a script drove to the box](pictures/08.png)
#
# The rovers on Mars are driven from the Earth. Their drivers see what the cameras saw minutes ago. In
# this lesson the robot is somewhere else too: on your neighbour's machine, or on the teacher's.
#
# **When you have finished, you can**
#
# - drive a robot over a network with `connect`, `sense` and `act`,
# - say what *realtime* and *lockstep* mean, and when to use which,
# - say what lag does to a driver, and cope with it,
# - ask an unknown robot which actions it takes.
#
# *About 70 minutes. Before: lesson 06.*
#
# **Recap.** Sense, decide, act, reward: that is one decision. So far your code ran in the same program as
# the world.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import bars, check, film, hint, plot, progress, report, show, solution, stop
from ai4u_edu.lessons.exercises.lesson_08 import late
from ai4u_edu.lessons.rollouts import drives
from ai4u_edu.remote import connect

# %% [markdown]
# ## Two programs
#
# A **server** is a program that waits for others to ask. The world below is served: it has an address.
# The **client** is the program that asks; in a moment that will be your script. The **token** in the
# address is a password, so only people you gave the address to can drive it.

# %%
live = show("box_chase", seed=1)
print(live.url.partition("token=")[0] + "token=...")

# %% [markdown]
# `connect(address)` takes the robot over; whoever drove it before gets it back in the end. Three methods
# are enough:
#
# | verb | does |
# |---|---|
# | `robot.sense()` | gives the percept, as soon as the last decision is over |
# | `robot.act(move=[...])` | answers it |
# | `robot.reset()` | begins an episode |
#
# Watch the world above while this runs. It lasts two seconds. In which direction will the robot turn?

# %%
with connect(live.url) as robot:
    robot.reset()
    for _ in range(24):
        percept = robot.sense()
        robot.act(move=[0, 0.3, 0, 0])
    print("it looks at the box by a cosine of", round(float(percept["orientation"][0]), 2))
stop()

# %% [markdown]
# With a friend: start `ai4u-edu play box_chase --host 0.0.0.0` on one machine. It prints an address for the
# other one; put that into `connect("...")`. The script there needs no world of its own.
#
# A loop over a robot gives one percept after another, until the episode is over:
#
# ```python
# for percept in robot:
#     robot.act(move=[1, 0, 0, 0])
# ```
#
# ### Exercise 08.1: a script drives
#
# Drive the robot to the box. (The check serves three worlds, and gives you a connected robot.) The recipe
# is an old one: turn until you face the box, then go.


# %% tags=["exercise-08.1"]
def script(robot):
    percept = robot.sense()
    robot.act(move=[1, 0, 0, 0])


# %%
check("08.1", script)

# %% [markdown]
# ## Who waits for whom?
#
# In the world above nobody waited: while your script was thinking, the robot went on. That is
# **realtime**, and it is how the real world is. With `connect(..., mode="lockstep")` the world stands
# still until your action is there. That is **lockstep**; it is slower or faster than a clock, but the
# same each time. Training needs that, and so do checks.
#
# In realtime, every message takes a while to arrive. What your script senses was true some time ago; that
# delay is **lag**. We can make lag without a network: `late` gives a driver percepts that are some
# decisions old. Here is one that drives well without lag. What will happen to it if its percepts are 0.25
# s old?


# %%
def quick(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -5 * left, 0, 0]}


def times_won(lag):
    """In how many of three worlds it finds the box."""
    return sum(each.won for each in drives(lambda: late(quick, lag), None, [1, 2, 3], limit=200))


won = {f"{lag} decisions late": times_won(lag) for lag in range(5)}
bars(won, ylabel="worlds won, of 3", title="the quick driver")

# %%
film(late(quick, lag=3), seed=1, limit=100)

# %% [markdown]
# It sees the box on the left and turns left; by the time it finds out, the box is on its right. So it
# turns back, too far again. Engineers call that *overshoot*, and a loop like this one *unstable*. You
# know it from showers in which the hot water takes a while to arrive.
#
# ### Exercise 08.2: late news
#
# Change the driver so that it finds the box with percepts that are 3 decisions (0.25 s) old.


# %% tags=["exercise-08.2"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -5 * left, 0, 0]}


# %%
check("08.2", careful)

# %%
film(late(careful, lag=3), seed=1, limit=200)

# %% [markdown]
# ## A robot that you don't know
#
# Your neighbour built a robot. What does it sense? What actions does it take? Ask it:
#
# - `list(robot.sense())`: the names of its readings,
# - `robot.spaces.observation`: what range each reading has,
# - `robot.spaces.action`: the actions it takes; `.low` and `.high` are the ends of the range, number by
#   number.
#
# ### Exercise 08.3: a robot that you don't know
#
# Return the action that is full power: every number as high as this robot takes it. The check gives you
# four robots with different actuators.


# %% tags=["exercise-08.3"]
def full_power(robot):
    return [1]


# %%
check("08.3", full_power)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Drive your neighbour's robot, over the network, with your script of 08.1. Then unplug the cable for a
#   second. What happens? (`connect` has an answer to that.)
# - How much lag can your careful driver cope with? Let `lag` grow until it fails.
# - Four people, one world: let everybody drive one agent of `soccer` with a script of their own:
#   `connect(address, agent="...")`.
#
# **Words of this lesson:** server, client, token, realtime, lockstep, lag. **Next:** 09, in which nobody
# tells the robot how.
