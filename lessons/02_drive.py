# %% [markdown]
# # 02 Drive: body, action, observation
#
# ![The robot's way across the plate, up to the box](pictures/02.png)
#
# You press a key, and the robot moves. What happens in between?
#
# **When you have finished, you can**
#
# - say where a body is, with three numbers,
# - say what the four numbers of an action do, and for how long,
# - read what a robot senses,
# - make a robot stop at the right place because it *looks*.
#
# *About 70 minutes. Before: lesson 00, and 01 if you have never programmed.*
#
# **Recap.** Shift + Enter runs a cell. A function gives the action: `{"move": [forward, turn, 0, 0]}`.

# %% tags=["setup"]
import math

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.lessons import (
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
)

# %% [markdown]
# ## Drive, and watch
#
# Run the cell, and drive with **W A S D**. **Space** jumps, **J** jumps forward: you need that for the
# low wall. Reach the cube. Then open the panel (the button at the top right), and choose **Details** at
# its top. Drive again, scroll down in the panel, and keep an eye on:
#
# - **Sensors**: the readings of the robot's sensors. Turn on the spot: which numbers change, and which
#   don't?
# - **Action**, below them: the four numbers that your keys turn into.

# %%
show("sample_scene", seed=1)

# %% [markdown]
# ## The body
#
# Now the same world in Python. `build` makes it, `reset` begins an episode. The **seed** is the number
# that decides everything random in the world: the same seed always gives the same episode.

# %%
sim = Scene.load("sample_scene").build()
sim.reset(seed=1)
robot = sim.world["robot"]
print("x, y in metres:    ", robot.position)
print("heading in degrees:", math.degrees(robot.heading))

# %% [markdown]
# The robot is a **body**: a disc of half a metre radius. Three numbers say where it is: **x** (to the
# right), **y** (up on the screen), and the **heading**: the direction it faces. Heading 0 faces right;
# turning left makes it grow, so at 90 degrees it faces up.
#
# ## The action
#
# `{"move": [forward, turn, jump, forward jump]}`. The first two go from -1 to 1, the others from 0 to 1.
#
# | number | above 0 | below 0 |
# |---|---|---|
# | forward | drives forward | drives backward |
# | turn | turns **right** | turns **left** |
# | jump | jumps | |
# | forward jump | jumps forward | |
#
# How fast is a 1? That depends on the robot's motor, the **actuator**. In this scene 1 drives at 4 m/s.
#
# One action holds for one **decision**: 5 ticks of the world's clock, which has 60 ticks a second. So a
# decision lasts 5/60 = 1/12 of a second. Let's take twelve, and look at the path:


# %%
def ahead(percept):
    return {"move": [0.5, 0, 0, 0]}


film("sample_scene", ahead, seed=1, limit=12)

# %% [markdown]
# Half of 4 m/s, for 12/12 of a second: 2 metres.
#
# ### Exercise 02.1: how far?
#
# A robot decides 12 times a second, and drives at `speed` metres a second. How many decisions does it take
# to cover `distance` metres? Compute it from the two numbers. (It need not be a whole number: the check rounds.)


# %% tags=["exercise-02.1"]
def decisions_for(distance, speed):
    return 0


# %%
check("02.1", decisions_for)

# %% [markdown]
# ### Exercise 02.2: a quarter turn
#
# A robot decides 12 times a second, and turns at `degrees_per_second`. How many decisions does it take to
# turn by 90 degrees?


# %% tags=["exercise-02.2"]
def decisions_for_quarter(degrees_per_second):
    return 0


# %%
check("02.2", decisions_for_quarter)

# %% [markdown]
# ## The observation
#
# A robot that only counts drives blindly. What does it sense? Before each decision every **sensor**
# reads once. All readings together are the **percept**. (Books also call it the *observation*.)

# %%
sim.reset(seed=1)
percept = sim.agents[0].percept
for name, reading in percept.items():
    print(f"{name:12}", getattr(reading, "shape", ""), reading if name != "vision" else "...")

# %% [markdown]
# - `bearing` says in which direction the cube is: two numbers that lesson 04 explains.
# - `orientation` says: is it in front of me (1), beside me (0), behind me (-1)? And how far away?
# - `velocity` says how fast the robot moves and turns.
# - `vision` is a small picture: 45 rays that look ahead.
# - `last_action` is what the robot did last.
# - Every robot has `id` and `done`: who am I, and is the episode over?
#
# Each of them comes from a **block**: `orientation` from an `OrientationSensor`, for example. The action
# `move` goes to an `RBMoveActuator`, and a `WASDRBMoveController` turns your keys into numbers. All of it
# together is a `BasicAgent`; `print(sim.agents[0])` lists its blocks. In lesson 03 you build one.
#
# Now let the robot drive straight on, and record the distance at each decision. `use_brain` says who
# decides from now on; `step` runs one decision. In this scene the distance is a share of the world's size:
# 1 would be as far as it goes. At the start it is 0.50, and the low wall is on the way.
#
# Guess first: what will the distance be after 40 decisions? Put a number in place of the three dots.

# %%
predict("02.1", ...)

# %%
sim.agents[0].use_brain(LocalBrain(controller=ahead))
distances = []
for _ in range(40):
    percept = sim.step()
    distances.append(float(percept["orientation"][1]))
plot({"distance": distances}, xlabel="decision", ylabel="distance to the cube (share)")
compare("02.1", round(distances[-1], 2))

# %% [markdown]
# The curve falls evenly, as the speed stays the same. Then it is flat: the robot stands at the low wall,
# its wheels turn, and it gets no nearer.
#
# ## An `if` makes it look
#
# This function looks before it acts. The first number of `orientation` says how directly the robot faces
# the cube: 1 is straight ahead.


# %%
def face_it(percept):
    facing = percept["orientation"][0]
    if facing > 0.95:
        return {"move": [0.5, 0, 0, 0]}
    return {"move": [0, -0.5, 0, 0]}


film("sample_scene", face_it, seed=7, limit=30)

# %% [markdown]
# Go through it line by line, as the robot does at every decision:
#
# 1. `facing` becomes the number of *this* moment. At the start it is 0.50.
# 2. Is it above 0.95? No. So Python skips the line below the `if`.
# 3. The last line returns an action that turns left.
#
# A twelfth of a second later the robot calls the function again. Now `facing` is larger, because the
# robot has turned. After a few decisions it is above 0.95. Then the function returns the *first* action,
# and ends there: the last line is not reached. The robot drives.
#
# Nobody told the robot how long it has to turn. It found out.
#
# ### Exercise 02.3: stop in time
#
# The robot faces the box. It should drive towards the box and stop **2 metres** from its centre. The
# distance is different in each world, so counting does not help: the robot has to look.
#
# Here the distance is in metres: `percept["orientation"][1]`. You need an `if`, as in `face_it`. At the
# end the robot has to stand still, without turning. Zeros brake; an empty action, `{}`, leaves the motor
# as it is, and the robot rolls on.


# %% tags=["exercise-02.3"]
def stop_in_time(percept):
    distance = percept["orientation"][1]
    return {"move": [0, 0, 0, 0]}


# %%
check("02.3", stop_in_time)

# %% [markdown]
# That was your first **agent**: something that senses, decides and acts, again and again.
#
# ```
#         percept                action
# world ----------> the agent ----------> world
#   ^                                       |
#   +---------------------------------------+
# ```

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A robot has the heading 0: it faces right. For a few decisions its action is `{"move": [0, 0.5,
# 0, 0]}`. What happens to the heading?
#
# - a: it grows
# - b: it falls below 0
# - c: it stays 0, because the first number is 0
#
# **2.** For this robot, 1 means 4 m/s. How far does it drive in 24 decisions with `{"move": [0.25, 0, 0,
# 0]}`?
#
# - a: 2 metres
# - b: 24 metres
# - c: 6 metres
#
# **3.** Two robots stop 2 metres before a box. One of them counts decisions, the other one compares the
# distance. Then somebody moves the box 3 metres away from them. What happens?
#
# - a: both stop at the right place again
# - b: both stop at the wrong place
# - c: only the one that compares stops at the right place

# %% tags=["exercise-02.exit"]
answers = ["", "", ""]

# %%
check("02.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Make the robot slow down gently: the nearer the box, the smaller the first number. Which formula did
#   you use? Does `check("02.3", ...)` still agree?
# - How many seconds do you need to reach the cube in `sample_scene`? The page shows the time.
# - Write a function that drives a figure of eight. You need to count decisions: a variable outside of the
#   function can do that (look up `global`).
#
# **Words of this lesson:** body, heading, actuator, action, sensor, percept, agent. **Next:** 03, in which
# you build an agent of your own.
