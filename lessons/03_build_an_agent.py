# %% [markdown]
# # 03 Build an agent from blocks
#
# ![A robot with its way to the box, from anywhere on the plate](pictures/03.png)
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
# *About 90 minutes without the gold exercise. Before: lesson 02.*
#
# **Recap.** An agent senses (percept), decides, and acts (action), twelve times a second.

# %% tags=["setup"]
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
# `ControlRequestor` puts agents into a world and asks each of them for its decisions. (The name comes
# from AI4U, a bigger sandbox of the same family.) `print(agent)` shows a table of its blocks: there is
# only a brain.
#
# ## How to read such a line
#
# `BasicAgent(body="robot", brains=[LocalBrain(controller=sleepy)])` has brackets in brackets. Read it from
# the inside to the outside:
#
# - `LocalBrain(...)` **builds** a brain. A name that begins with a capital letter is a *class*: a plan.
#   With brackets after it you get one object that is built by this plan. The brackets hold its
#   parameters, each with its name: here `controller` becomes the function `sleepy`.
# - `[...]` is a list, and this one holds one brain. Several blocks in a list have commas between them.
# - `BasicAgent(...)` builds an agent from the name of a body and from lists of blocks.
#
# With many blocks we write one on each line. Python does not mind the line breaks, but it needs the commas:

# %%
two_senses = BasicAgent(
    body="robot",
    sensors=[
        VelocitySensor(),
        TouchSensor(target="box", perception_key="bumper"),
    ],
    brains=[LocalBrain(controller=sleepy)],
)
ControlRequestor(make_world(), [two_senses]).reset()
print(two_senses.percept)

# %% [markdown]
# Each sensor puts its reading into the percept, under its **perception key**. The key is made from the
# name of the class: a `VelocitySensor` reads `velocity`. With the parameter `perception_key` you choose
# another one, such as `bumper`. Two sensors need two different keys. (`id` and `done` are there in every
# percept.)
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
# ### Exercise 03.1: legs
#
# Give the agent an `RBMoveActuator`. An action of 1 should mean driving at **2 metres per second**
# (`move_amount`), or turning at **3 radians per second** (`turn_amount`; a full turn is 6.28 radians).
#
# (The other two numbers of the action jump. `jump_power` is the speed upwards, and `jump_forward_power`
# the speed that a forward jump adds. With `jump_power=4` the robot jumps 0.8 metres high. You don't need
# that here.)


# %% tags=["exercise-03.1"]
walker = BasicAgent(
    body="robot",
    actuators=[],
)

# %%
check("03.1", walker)

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
# ### Exercise 03.2: eyes and a bumper
#
# Give the agent two sensors: one for the direction of the box, and one that tells whether the robot
# **touches** it. These are the names of all sensors:

# %%
print([name for name in dir() if name.endswith("Sensor")])

# %% tags=["exercise-03.2"]
watcher = BasicAgent(
    body="robot",
    sensors=[],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)

# %%
check("03.2", watcher)

# %% [markdown]
# ## Praise and blame
#
# How does an agent know that it did well? Somebody has to tell it, in numbers: the **reward**. After each
# decision a reward function looks at the world, and pays the agent or makes it pay. An agent may have
# several of them, each with its own name.
#
# ### Exercise 03.3: praise and blame
#
# - Touching the box: **+10**, and the episode **ends**.
# - Falling off the plate: **-1**, and the episode ends.


# %% tags=["exercise-03.3"]
keen = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[],
)

# %%
check("03.3", keen)

# %% [markdown]
# ## A brain
#
# A `LocalBrain` asks a **controller**: a function from percept to action. Yours has to turn towards the
# box. Think before you write: when the box is on the left, the first number of the bearing is above 0.
# Which sign does the second number of the action need, to turn left?
#
# One more piece of Python makes this shorter. `A if question else B` is a *value*: A if the answer is yes,
# and B if it is no. So these two cells do the same:

# %%
left = 0.3
if left > 0:
    turn = -1
else:
    turn = 1
print(turn)

# %%
turn = -1 if left > 0 else 1
print(turn)

# %% [markdown]
# ### Exercise 03.4: to the box, from anywhere
#
# Write `steer`. Robot and box are somewhere else in each world, and the plate has an edge!


# %% tags=["exercise-03.4"]
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
check("03.4", finder)

# %% [markdown]
# See it drive, in your own world. Guess first: the touch pays 10, and a fall costs 1. What will its rewards
# add up to in this episode? Put a number in place of the three dots.

# %%
predict("03.1", ...)

# %%
sim = ControlRequestor(make_world(), [finder])
film(sim, seed=1)
compare("03.1", finder.ledger.episode_total)
print(finder)
bars(finder.ledger.episode_terms, ylabel="reward of the episode", title="what it was paid for")

# %%
show(sim)

# %% [markdown]
# ### Exercise 03.5: gold: the fewest decisions
#
# *For fast finishers; optional.* The usual `steer` needs 21 to 23 decisions, on average over 30
# worlds. Write one that needs **20 or fewer**. The robot and its legs are the same as in 03.4. What takes
# so long?


# %% tags=["exercise-03.5"]
def quick_steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, 0, 0, 0]}


# %%
check("03.5", quick_steer)

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** An agent has a body, sensors, actuators and rewards, but its controller returns `{}`. What happens?
#
# - a: it stays where it is: nobody decides on an action
# - b: the rewards make it move
# - c: it drives at random
#
# **2.** The bearing reads `[-0.6, 0.8]`. Where is the box?
#
# - a: ahead, on the left
# - b: behind, on the left
# - c: ahead, on the right
#
# **3.** You leave out `cause_episode_to_end=True` of the `TouchRewardFunc`. The robot touches the box.
# What happens?
#
# - a: the robot gets no reward for the touch
# - b: the robot gets its reward, and the episode goes on
# - c: the episode ends without a reward

# %% tags=["exercise-03.exit"]
answers = ["", "", ""]

# %%
check("03.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Put a second box into `make_world`, and an agent that loves one and fears the other: two rewards, two
#   bearings.
# - How little can it sense and still find the box? Try `OrientationSensor(target="box")`, which has only the
#   cosine. (Lesson 04 is about that.)
# - Let the robot begin somewhere else in each episode: `add_body(..., random=Variation(x=(-4, 4),
#   y=(-4, 4), heading_deg=(-180, 180)))`.
#
# **Words of this lesson:** block, parameter, sensor, reading, actuator, reward function, brain, controller.
# **Next:** 04, in which you find out what an agent can know.
