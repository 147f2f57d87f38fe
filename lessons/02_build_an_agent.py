# %% [markdown]
# # 02 Build an agent from blocks
#
# ![A robot with its way to the box, from anywhere on the plate](pictures/02.png)
#
# So far you drove robots that others had built. Today you build one: legs, eyes, a bumper, a sense of
# what is good, and a brain.
#
# **When you have finished, you can**
#
# - name the five parts of an agent, and say what each is for,
# - put them together in Python,
# - read the table of an agent,
# - make an agent that finds a box wherever it lies.
#
# *About 80 minutes. Before: lesson 01.*
#
# **Recap.** An agent senses (percept), decides, and acts (action), twelve times a second.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import bars, check, film, hint, progress, report, show, solution

# %% [markdown]
# ## A world
#
# First it needs a place to live: a plate of 10 by 10 metres above the void, a disc that will be the
# robot, and a box. We write a function for it, as we need it more than once.


# %%
def make_world(seed=0):
    world = World(seed=seed)
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), position=(-3, 0))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 1), tags=("target",))
    return world


# %% [markdown]
# ## Five parts
#
# | part | block | question |
# |---|---|---|
# | body | a body of the world | Who am I? |
# | sensors | `BearingSensor`, `TouchSensor`, ... | What do I know? |
# | actuators | `RBMoveActuator`, ... | What can I do? |
# | rewards | `TouchRewardFunc`, `FallReward`, ... | What is good for me? |
# | brain | `LocalBrain` with a controller | What do I do next? |
#
# A body with only a brain is already an agent. It just can't do anything yet.


# %%
def sleepy(percept):
    return {}


agent = BasicAgent(body="robot", brains=[LocalBrain(controller=sleepy)])
sim = ControlRequestor(make_world(), [agent])
sim.reset()
print(agent)

# %% [markdown]
# `ControlRequestor` puts agents into a world and asks each of them for its decisions. (The name comes from
# AI4U, a bigger sandbox of the same family.) `print(agent)` shows a table of its blocks: it is empty.
#
# ## Legs
#
# Every block has **parameters**. If you get one wrong, it tells you:

# %%
try:
    RBMoveActuator(move_amuont=2)
except AI4UError as error:
    print(error)

# %% [markdown]
# ### Exercise 02.1: legs
#
# Give the agent an `RBMoveActuator`. An action of 1 should mean driving at **2 metres per second**
# (`move_amount`), or turning at **3 radians per second** (`turn_amount`; a full turn is 6.28 radians).


# %% tags=["exercise-02.1"]
walker = BasicAgent(
    body="robot",
    actuators=[],
)

# %%
check("02.1", walker)

# %% [markdown]
# ## Eyes and a bumper
#
# A sensor turns something about the world into numbers. That is all the agent will ever know: its brain
# sees the readings, never the world.
#
# `BearingSensor(target="box")` reads the direction of the box, as two numbers:
#
# - the first (the *sine*) is above 0 where the box is on the **left**, below 0 on the **right**,
# - the second (the *cosine*) is above 0 where the box is **ahead**, below 0 **behind**.
#
# ### Exercise 02.2: eyes and a bumper
#
# Give the agent two sensors: one for the direction of the box, and one that tells whether the robot
# **touches** it. All sensors stand in the list that `ai4u-edu blocks` prints, and here:

# %%
print([name for name in dir() if name.endswith("Sensor")])

# %% tags=["exercise-02.2"]
watcher = BasicAgent(
    body="robot",
    sensors=[],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)

# %%
check("02.2", watcher)

# %% [markdown]
# ## Praise and blame
#
# How does an agent know that it did well? Somebody has to tell it, in numbers: the **reward**. A reward
# function looks at the world after each decision and pays, or makes the agent pay. An agent may have
# several; each has its name.
#
# ### Exercise 02.3: praise and blame
#
# - Touching the box: **+10**, and the episode **ends**.
# - Falling off the plate: **-1**, and the episode ends.


# %% tags=["exercise-02.3"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[],
)

# %%
check("02.3", keen)

# %% [markdown]
# ## A brain
#
# A `LocalBrain` asks a **controller**: a function from percept to action. Yours has to turn towards the
# box. Think before you write: when the box is on the left, the first number of the bearing is above 0.
# Which sign does the second number of the action need, to turn left?
#
# ### Exercise 02.4: to the box, from anywhere
#
# Write `steer`. Robot and box are somewhere else in each world, and the plate has an edge!


# %% tags=["exercise-02.4"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, 0, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
    brains=[LocalBrain(controller=steer)],
)

# %%
check("02.4", finder)

# %% [markdown]
# See it drive, in your own world:

# %%
sim = ControlRequestor(make_world(), [finder])
film(sim, seed=1)
print(finder)
bars(finder.ledger.episode_terms, ylabel="reward of the episode", title="what it was paid for")

# %%
show(sim)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Put a second box into `make_world`, and an agent that loves one and fears the other: two rewards, two
#   bearings.
# - How little can it sense and still find the box? Try `OrientationSensor(target="box")`, which has the
#   cosine alone. (Lesson 03 is about that.)
# - Let the robot begin somewhere else in each episode: `add_body(..., random=Variation(x=(-4, 4),
#   y=(-4, 4), heading_deg=(-180, 180)))`.
#
# **Words of this lesson:** block, parameter, sensor, reading, actuator, reward function, brain, controller.
# **Next:** 03, in which you find out what an agent can know.
