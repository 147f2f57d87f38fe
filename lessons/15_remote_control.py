# %% [markdown]
# # 15 Remote control: your script, another machine
#
# ![A robot that a script drove to the box](pictures/15.png)
#
# Rovers on Mars are driven from Earth. Their drivers see what the cameras saw minutes ago. In this lesson
# your robot is somewhere else too: on your neighbour's machine, or on the teacher's.
#
# **When you have finished, you can**
#
# - drive a robot over a network with `connect`, `sense` and `act`,
# - say what *realtime* and *lockstep* mean, and when to use which,
# - say what a robot does when its script falls silent,
# - say what lag does to a driver, and cope with it,
# - ask an unknown robot which actions it takes,
# - say what a `RemoteBrain` is, and what it sends.
#
# *About 95 minutes. Before: lesson 08.*
#
# **Recap.** Sense, decide, act, reward: that is one decision. So far your code ran in the same program as
# the world.

# %% tags=["setup"]
import time

from ai4u_edu import *
from ai4u_edu.lessons import (
    bars,
    check,
    compare,
    film,
    hint,
    plot,
    predict,
    progress,
    report,
    show,
    solution,
    stop,
)
from ai4u_edu.lessons.exercises.lesson_15 import late, overheard
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
# `connect(address)` takes over the robot. When you are done, whoever drove it before gets it back. Three
# methods are enough:
#
# | verb | does |
# |---|---|
# | `robot.sense()` | gives the percept, as soon as the last decision is over |
# | `robot.act(move=[...])` | answers it with an action |
# | `robot.reset()` | begins an episode |
#
# Watch the world above while this runs. It lasts two seconds. In which direction will the robot turn,
# left or right?

# %%
predict("15.turn", ...)  # write "left" or "right" in place of the three dots

# %%
with connect(live.url) as robot:
    robot.reset()
    for _ in range(24):
        percept = robot.sense()
        robot.act(move=[0, 0.3, 0, 0])
stop()
compare("15.turn", "right")

# %% [markdown]
# With a friend: start `ai4u-edu play box_chase --host 0.0.0.0` on one machine. It prints an address for
# the other one; put that into `connect("...")`. The script there needs no world of its own.
#
# A loop over a robot gives one percept after another, until the episode is over:
#
# ```python
# for percept in robot:
#     robot.act(move=[1, 0, 0, 0])
# ```
#
# ### Exercise 15.1: a script drives
#
# Drive the robot to the box. (The check serves three worlds, and gives you a connected robot.) The recipe
# is an old one: turn until you face the box, then go.


# %% tags=["exercise-15.1"]
def script(robot):
    percept = robot.sense()
    robot.act(move=[1, 0, 0, 0])


# %%
check("15.1", script)

# %% [markdown]
# ## Who waits for whom?
#
# In the world above nobody waited: while your script was thinking, the robot went on. That is
# **realtime**, and it is how the real world is. With `connect(..., mode="lockstep")` the world stands
# still until your action is there. That is **lockstep**. It may run slower or faster than a clock, but it
# gives the same result each time. Training needs that, and so do checks.
#
# ## When the script falls silent
#
# A script can crash, or a cable can be pulled out. What should the robot do until it hears from its
# script again? You choose that when you connect:
#
# | `on_missing=` | the robot |
# |---|---|
# | `"hold"` | repeats the last action (the default) |
# | `"coast"` | uses no motor: it rolls until friction stops it |
# | `"stop"` | gets zeros: it stands still at once |
#
# The script below drives forward at one fifth of full speed (1 metre per second), and then says nothing
# for a second. How many metres does the robot go in that second, with each of the three?

# %%
predict("15.silence", [..., ..., ...])

# %%
live = show("box_chase", seed=1)
driven = {}
for on_missing in ("hold", "coast", "stop"):
    with connect(live.url, on_missing=on_missing) as robot:
        robot.reset(seed=2)
        robot.sense()
        robot.act(move=[0.2, 0, 0, 0])
        robot.sense()
        x, y = live.sim.world["robot"].position
        time.sleep(1)  # the script is silent
        x_now, y_now = live.sim.world["robot"].position
    driven[on_missing] = ((x_now - x) ** 2 + (y_now - y) ** 2) ** 0.5
compare("15.silence", driven)

# %% [markdown]
# In lockstep the world waits for the script, but not for ever. After 2 seconds of silence it goes on
# without it. That limit is the **receive time-out**. When the script speaks again, the world waits for it
# again. Here the script is silent for 3 seconds. How many decisions does the robot take in that time?

# %%
with connect(live.url, mode="lockstep") as robot:
    robot.reset(seed=2)
    before = robot.sense().step
    time.sleep(3)
    robot.act(move=[0, 0, 0, 0])
    print("decisions:", robot.sense().step - before)
stop()

# %% [markdown]
# It waited for 2 seconds. In the third one it went on, at 12 decisions per second. A training that
# computes for longer than 2 seconds between two actions needs a longer time-out: `ai4u-edu play box_chase
# --receive-timeout 10000` (in milliseconds).
#
# ## Late news
#
# In realtime, every message takes a while to arrive. What your script senses was true some time ago; that
# delay is **lag**. We can make lag without a network: `late` gives a driver percepts that are some
# decisions old. Here is one that drives well without lag. In how many of three worlds will it find the
# box if its percepts are 3 decisions (0.25 s) old?

# %%
predict("15.lag", ...)


# %%
def quick(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -5 * left, 0, 0]}


def times_won(lag):
    """In how many of three worlds it finds the box."""
    return sum(each.won for each in drives(lambda: late(quick, lag), None, [1, 2, 3], limit=200))


won = [times_won(lag) for lag in range(5)]
named = {f"{lag} decisions late": won[lag] for lag in range(5)}
bars(named, ylabel="worlds won, of 3", title="the quick driver")
compare("15.lag", won[3])

# %%
film(late(quick, lag=3), seed=1, limit=100)

# %% [markdown]
# It senses the box on its left and turns left. By the time it finds out, the box is on its right. So it
# turns back, too far again. Engineers call that *overshoot*, and a loop like this one *unstable*. You
# know this from a shower where the hot water takes a while to arrive.
#
# ### Exercise 15.2: late news
#
# Change the driver so that it finds the box with percepts that are 3 decisions (0.25 s) old.


# %% tags=["exercise-15.2"]
def careful(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -5 * left, 0, 0]}


# %%
check("15.2", careful)

# %%
film(late(careful, lag=3), seed=1, limit=200)

# %% [markdown]
# ## A robot that you don't know
#
# Your neighbour built a robot. What does it sense? What actions does it take? Ask it:
#
# - `list(robot.sense())`: the names of its readings,
# - `robot.spaces.observation`: what range each reading has,
# - `robot.spaces.action`: the actions it takes; `.low` and `.high` are the ends of the range, for each
#   number.
#
# ### Exercise 15.3: a robot that you don't know
#
# Return the action that is full power: every number as high as this robot takes it. The check gives you
# four robots with different actuators.


# %% tags=["exercise-15.3"]
def full_power(robot):
    return [1]


# %%
check("15.3", full_power)

# %% [markdown]
# ## Faster than the clock
#
# A simulated second need not last a second. The **time scale** says how fast the world's time runs: 1 is
# real time, 4 is four times as fast. In the first world of this lesson, 24 decisions lasted 2 seconds.
# How many seconds do they last now?

# %%
predict("15.seconds", ...)

# %%
sim = Scene.load("box_chase").build()
sim.default_time_scale = 4
live = show(sim, seed=1)
with connect(live.url) as robot:
    robot.reset()
    began = time.perf_counter()
    for _ in range(24):
        robot.sense()
        robot.act(move=[0, 0.3, 0, 0])
    seconds = round(time.perf_counter() - began, 1)
stop()
compare("15.seconds", seconds)

# %% [markdown]
# In the page you choose the speed with the mouse, and `ai4u-edu play box_chase --time-scale 4` begins
# with it. Training ignores the clock: it runs as fast as the computer can.
#
# ## The other way round: RemoteBrain
#
# So far your script called the world. In AI4U, the project that this sandbox grew out of, the **world
# calls the script**. The robot gets a `RemoteBrain`: a brain that asks a program at some address (`host`
# and `port`) what to do. It has the same two settings that you know: `receive_timeout` in milliseconds
# (at least 200), and `on_missing`.


# %%
def far_away(port):
    return RemoteBrain(host="127.0.0.1", port=port, receive_timeout=500, on_missing="stop")


# %% [markdown]
# What do world and script say to each other? The rules of such a dialogue are called a **protocol**.
# AI4U's is simple: the world sends its readings by name, with the reward, the number of the step, and
# whether the episode is over (`done`). The script answers with the actuator's name, how many numbers
# follow, and the numbers. `overheard` runs a world with your `RemoteBrain` and a script that gives two
# answers, and then falls silent:

# %%
for line in overheard(far_away, ["move;4;1;0;0;0", "move;4;0;0.3;0;0"]):
    print(line)

# %% [markdown]
# In this protocol no message has a number. A lost message can't be told from a late one, so the session
# is over when one is missing. `connect` numbers its messages; that is why it can pick up where it was.
#
# A script for AI4U looks like this. It uses AI4U's own package, which needs older versions of other
# packages: install it into a Python of its own (`pip install ai4u`).
#
# ```python
# import AI4UEnv
# import gymnasium as gym
# from ai4u.controllers import BasicGymController
#
# env = gym.make(
#     "AI4UEnv-v0",
#     controller_class=BasicGymController,
#     config={"server_IP": "127.0.0.1", "server_port": 8080},
# )
# observation, info = env.reset()
# for _ in range(100):
#     observation, reward, done, truncated, info = env.step([0, 0.3, 0, 0])
# ```
#
# And in another terminal, the world that calls it: `ai4u-edu play box_chase --brain ai4u://127.0.0.1:8080
# --port 8000`. The same script drives a robot in AI4U's own worlds, and in ours.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** A script drives in realtime with the default settings. It thinks for half a second. What does the
# robot do meanwhile?
#
# - a: It stands still until the next action comes.
# - b: It repeats its last action.
# - c: Nothing: the world stands still.
#
# **2.** A robot gets its percepts 0.25 s late, and turns past the box each time. What helps?
#
# - a: Turning faster, to be there before the news gets old.
# - b: Deciding more often.
# - c: Turning and driving more slowly.
#
# **3.** A training program needs 5 seconds between some of its actions. The robot should miss none of
# them. How do you connect?
#
# - a: In lockstep, with a receive time-out above 5 seconds.
# - b: In lockstep: there the world waits for as long as it takes.
# - c: In realtime, with `on_missing="stop"`.

# %% tags=["exercise-15.exit"]
answers = ["", "", ""]

# %%
check("15.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Drive your neighbour's robot over the network with your script of 15.1. Then unplug the cable for a
#   second. What does the robot do, and what does your script do when the cable is back?
# - How much lag can your careful driver cope with? Let `lag` grow until it fails.
# - Four people, one world: let everybody drive one agent of `soccer` with a script of their own:
#   `connect(address, agent="...")`.
#
# **Words of this lesson:** server, client, token, realtime, lockstep, receive time-out, lag, time scale,
# RemoteBrain, protocol.
