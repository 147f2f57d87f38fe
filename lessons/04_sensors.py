# %% [markdown]
# # 04 Sensors: what can it know?
#
# ![A robot that searched for the box by turning, and then drove to it](pictures/04.png)
#
# Close your eyes, and let somebody call "warm" or "cold". You will find the chair. But can you tell
# whether it is on your left or on your right? A robot knows what its sensors tell it, and nothing else.
#
# **When you have finished, you can**
#
# - say what a sensor can tell apart, and what it can't,
# - find something with a poor sensor, by moving,
# - read a direction from a sine and a cosine,
# - choose sensors for a task, and say why.
#
# *About 95 minutes without the gold exercise, so two classes: cut after 04.3. Before: lesson 03.*
#
# **Recap.** A sensor turns something about the world into numbers. The brain gets the numbers, never the
# world.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.learn.training import vary
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


def look(sensors, box=(3, 1), wall=False):
    """What a robot in the middle, that looks to the right, senses of a box at a place."""
    world = World()
    world.add_floor("plate", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=box, tags=("target",))
    if wall:
        middle = (box[0] * 0.6, box[1] * 0.6)
        angle = math.degrees(math.atan2(box[1], box[0]))
        shape = BoxShape(size=(0.3, 2))
        world.add_body("wall", shape, position=middle, heading_deg=angle, kind="static")
    agent = BasicAgent(
        body="robot", sensors=sensors, brains=[LocalBrain(controller=lambda percept: {})]
    )
    ControlRequestor(world, [agent]).reset()
    return {key: value for key, value in agent.percept.items() if key not in ("id", "done")}


# %% [markdown]
# ## Warm and cold
#
# `OrientationSensor` gives two numbers. The first says how directly the robot faces its target: **1**
# straight ahead, **0** beside it, **-1** behind. Mathematicians call it the *cosine* of the angle. The
# second number is the distance, in metres.
#
# `look` puts a robot in the middle of a plate, facing right, and a box somewhere. We try four places: (3,
# 1), (3, -1), (-3, 1) and (1, 3). Guess first: for which **two** of them will the readings be the same?
# Write their numbers, from 1 to 4, in place of the dots.

# %%
predict("04.1", [..., ...])

# %%
for place in [(3, 1), (3, -1), (-3, 1), (1, 3)]:
    print(place, look([OrientationSensor(target="box", normalized=False)], box=place))
compare("04.1", [1, 2])

# %% [markdown]
# The box at (3, 1) lies ahead and a little to the left; the one at (3, -1) ahead and a little to the
# right. Two different worlds, and the robot gets the same numbers. Whatever its brain does, it must do
# the same in both.
#
# ### Exercise 04.1: the twin
#
# The robot stands at (0, 0) and faces right. A box lies at (x, y). Where else could it be, so that the
# robot senses exactly the same? Return the other place.


# %% tags=["exercise-04.1"]
def twin(x, y):
    return (x, y)


# %%
check("04.1", twin)

# %% [markdown]
# ## Poor eyes, and a good idea
#
# So a robot with this sensor can never find the box? It can, because it can **move**. If you turn a
# little, warm becomes warmer or colder. Sensing and acting belong together.
#
# ### Exercise 04.2: search
#
# Find the box with nothing but the cosine: `percept["orientation"][0]`. One idea: turn until you face the
# box, then drive. How precise does that have to be? In one decision the robot turns by up to a quarter of a
# radian, about 14 degrees; the cosine of 14 degrees is 0.97.


# %% tags=["exercise-04.2"]
def search(percept):
    cosine = percept["orientation"][0]
    return {"move": [1, 0, 0, 0]}


# %%
check("04.2", search)

# %% [markdown]
# ## Two numbers for a direction
#
# `BearingSensor` adds the number that was missing: the **sine**. It is above 0 where the target is on the
# left, and below 0 on the right. Move a box around the robot, once around the circle:

# %%
angles = range(-180, 181, 10)
readings = [
    look(
        [BearingSensor(target="box")],
        box=(3 * math.cos(math.radians(angle)), 3 * math.sin(math.radians(angle))),
    )["bearing"]
    for angle in angles
]
plot(
    {"sine": [reading[0] for reading in readings], "cosine": [reading[1] for reading in readings]},
    x=angles,
    xlabel="angle to the box in degrees (above 0: left)",
    ylabel="reading",
)

# %% [markdown]
# Lay a ruler flat across the plot. Each height of the cosine curve belongs to two angles, and so does
# each height of the sine curve. Both together belong to only one.
#
# ### Exercise 04.3: the angle
#
# Compute the angle to the box **in degrees**, from -180 to 180, above 0 on the left, from the two numbers
# of the bearing. `math.atan2(sine, cosine)` gives the angle in radians, `math.degrees` turns radians
# into degrees.


# %% tags=["exercise-04.3"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return 0


# %%
check("04.3", angle_to_box)

# %% [markdown]
# ## Rays
#
# Orientation and bearing know where the box is even if a wall stands in between. No eyes can do that. A
# **ray sensor** is more honest: it sends out rays, and each tells what it hits first, and how far away
# that is. This is called *ray casting*. `group_code` gives each kind of thing a number, and
# `field_of_view` is the angle that the rays cover.

# %%
rays = LinearRayCastingSensor(
    group_code={"target": 1, "wall": 2},
    number_of_rays=5,
    field_of_view=60,
    vision_max_distance=8,
    return_distance=True,
    normalized=False,
    normalize_distance=False,
)
print("a box:     ", look([rays], box=(4, 0)))
print("with a wall", look([rays], box=(4, 0), wall=True))

# %% [markdown]
# For each ray, the rightmost first: a **code** (which kind of thing? 1 is a target here, 0 nothing), then
# the **distance** in metres. The wall in our world has no code of its own yet: things without a known tag
# read 0, but their distance is there.
#
# In the page, rays are lines with a dot where they meet something. Drive around in the sample scene, and
# watch them. (There it is a `RayCastingSensor`, whose rays form a small picture, row upon row.)

# %%
show("sample_scene", seed=2)

# %% [markdown]
# ### Exercise 04.4: tell them apart
#
# Choose sensors so that these three pairs of worlds give **different** percepts. Use as few sensors as
# you can.
#
# 1. the box on the left, or at the same angle on the right,
# 2. the box near, or far away in the same direction,
# 3. the box in sight, or behind a wall.


# %% tags=["exercise-04.4"]
my_sensors = [OrientationSensor(target="box")]

# %%
check("04.4", my_sensors)

# %% [markdown]
# ## Settings that every sensor has
#
# | setting | what it does |
# |---|---|
# | `stacked_observations=3` | the percept holds the last three readings, the oldest first |
# | `normalized=True` | divides the reading by its largest possible value, so that it is at most 1 |
# | `noise=0.1`, `delay=5` | makes the reading inexact, or five decisions old |
# | `is_active=False` | leaves the sensor out, although its line stays in your program |
# | `resetable=False` | keeps the stack when a new episode begins; otherwise it is filled again |
#
# Why would you **stack**? A single distance does not tell you whether the box comes nearer. Three of them do.
# And why **normalise**? A network learns badly if one number goes up to 1 and another one up to 300.
#
# (In the cell you will see `lambda percept: ...`. That is a small function without a name, in one line. What
# comes after the colon is its answer.)

# %%
print(look([PositionSensor(target="box", normalized=False)]))
print(look([PositionSensor(target="box", normalized=True)]))
print(look([BearingSensor(target="box", is_active=False), TouchSensor(target="box")]))


def drive_and_stack():
    world = World()
    world.add_floor("plate", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(4, 1))
    distance = OrientationSensor(
        target="box", info="distance", normalized=False, stacked_observations=3
    )
    agent = BasicAgent(
        body="robot",
        sensors=[distance, StepSensor(), RewardSensor()],
        actuators=[RBMoveActuator(move_amount=2)],
        rewards=[MinDistReward(target="box")],
        brains=[LocalBrain(controller=lambda percept: {"move": [1, 0, 0, 0]})],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset()
    for _ in range(4):
        print(agent.percept["orientation"].ravel(), agent.percept["steps"], agent.percept["reward"])
        sim.step()


drive_and_stack()

# %% [markdown]
# At the start the stack is filled with the first reading; then a new distance comes in at the end of each
# row.
#
# Some sensors look not at the world, but at the **agent itself**. `StepSensor` reads how many decisions
# it has taken in this episode, and `RewardSensor` the reward of the last one: the two numbers at the
# right. `DoneSensor` reads whether the episode is over, and `IDSensor` who the agent is; every agent has
# these two.
#
# And one sensor is made of others. A `FloatArrayCompositeSensor` joins the readings of its children to
# one row of numbers, which is what a network likes best. Each number has to be from -1 to 1, so its
# children have to be normalised:

# %%
print(
    look(
        [
            FloatArrayCompositeSensor(
                sensors=[BearingSensor(target="box"), TouchSensor(target="box")]
            )
        ]
    )
)

# %% [markdown]
# ### Exercise 04.5: gold: as few numbers as possible
#
# *For fast finishers; optional.* Tell the three pairs of exercise 04.4 apart once more. This time
# only the numbers of the percept count, not the sensors: **three numbers** are enough. (61 rays are 122
# numbers.) `help` prints what a sensor can do, for example `help(OrientationSensor)`.


# %% tags=["exercise-04.5"]
my_few_numbers = [OrientationSensor(target="box")]

# %%
check("04.5", my_few_numbers)

# %% [markdown]
# ## Try many: how much noise is too much?
#
# One drive proves little: maybe the robot was lucky. `vary` changes one number of a scene, and lets a driver
# drive from the same 20 starts with each value. Here a trained network looks for the box, and the sensor
# for its direction gets more and more inexact. With which noise will it begin to miss the box? Guess first.

# %%
vary("zoo", "box_chase", "orientation.noise", [0, 1, 2, 4])

# %% [markdown]
# `success` is how often it reached the box. With 20 other starts the share would be a bit different, so the
# next column says where the true share probably lies. If two of these ranges overlap a lot, you can't tell yet
# which value is better: take more starts (`episodes=100`).
#
# This robot has rays, too. Put `"vision.noise"` in place of `"orientation.noise"`. Which of its two
# sensors does this driver rely on? (In the page, the tab Teach has such experiments under "Try many".)

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A robot has a cosine as its only sensor, and reads 0. Where is the target?
#
# - a: straight ahead
# - b: beside it, and the robot can't know on which side
# - c: on the left
#
# **2.** Two different worlds give a robot exactly the same percept. Its controller is a function. What
# follows?
#
# - a: it does the same in both worlds
# - b: it does different things, because the worlds are different
# - c: it does nothing, because it can't decide
#
# **3.** You want a robot to notice whether a ball comes nearer. It has a sensor for the distance. What helps?
#
# - a: `normalized=True`
# - b: a second sensor for the same distance
# - c: `stacked_observations=2`

# %% tags=["exercise-04.exit"]
answers = ["", "", ""]

# %%
check("04.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Real sensors are never exact. Give a sensor `noise=0.1` and drive with it. How much noise does it take
#   to make your `search` fail? What would help: several readings at once (`stacked_observations=3`)?
# - `delay=5` shows the robot what it would have sensed five decisions ago. Try to drive like that, in
#   `show`.
# - How many rays do you need to find a 1 m box 8 m away, without turning? Compute first.
#
# **Words of this lesson:** reading, cosine, sine, bearing, ray, code, noise. **Next:** 05, in which two
# wires are enough for a brain.
