# %% [markdown]
# # 03 Sensors: what can it know?
#
# ![A robot that searched for the box by turning, and then drove to it](pictures/03.png)
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
# *About 80 minutes. Before: lesson 02.*
#
# **Recap.** A sensor turns something about the world into numbers. The brain gets the numbers, never the
# world.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.lessons import check, film, hint, plot, progress, report, show, solution


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
# `look` puts a robot in the middle of a plate, facing right, and a box somewhere. Before you run this:
# for which two boxes will the readings be the same?

# %%
for place in [(3, 1), (3, -1), (-3, 1), (1, 3)]:
    print(place, look([OrientationSensor(target="box", normalized=False)], box=place))

# %% [markdown]
# The box at (3, 1) lies ahead and a little to the left; the one at (3, -1) ahead and a little to the
# right. Two different worlds, and the robot gets the same numbers. Whatever its brain does, it must do
# the same in both.
#
# ### Exercise 03.1: the twin
#
# The robot stands at (0, 0) and faces right. A box lies at (x, y). Where else could it be, so that the
# robot senses exactly the same? Return the other place.


# %% tags=["exercise-03.1"]
def twin(x, y):
    return (x, y)


# %%
check("03.1", twin)

# %% [markdown]
# ## Poor eyes, and a good idea
#
# So a robot with this sensor can never find the box? It can, because it can **move**. If you turn a
# little, warm becomes warmer or colder. Sensing and acting belong together.
#
# ### Exercise 03.2: search
#
# Find the box with the cosine alone: `percept["orientation"][0]`. One idea: turn until you look at the
# box, then drive. How exact is exact enough? In one decision the robot turns by up to a quarter of a
# radian, about 14 degrees; the cosine of 14 degrees is 0.97.


# %% tags=["exercise-03.2"]
def search(percept):
    cosine = percept["orientation"][0]
    return {"move": [1, 0, 0, 0]}


# %%
check("03.2", search)

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
# ### Exercise 03.3: the angle
#
# Compute the angle to the box **in degrees**, from -180 to 180, above 0 on the left, from the two numbers
# of the bearing. `math.atan2(sine, cosine)` gives the angle in radians, `math.degrees` makes degrees of
# radians.


# %% tags=["exercise-03.3"]
def angle_to_box(percept):
    sine, cosine = percept["bearing"]
    return 0


# %%
check("03.3", angle_to_box)

# %% [markdown]
# ## Rays
#
# Orientation and bearing know where the box is even if a wall stands in between. No eyes can do that. A
# **ray sensor** is more honest: it sends out rays, and each tells what it hits first, and how far away
# that is.

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
# watch them:

# %%
show("sample_scene", seed=2)

# %% [markdown]
# ### Exercise 03.4: tell them apart
#
# Choose sensors so that these three pairs of worlds give **different** percepts. Use as few sensors as
# you can.
#
# 1. the box on the left, or at the same angle on the right,
# 2. the box near, or far away in the same direction,
# 3. the box in sight, or behind a wall.


# %% tags=["exercise-03.4"]
my_sensors = [OrientationSensor(target="box")]

# %%
check("03.4", my_sensors)

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
# **Words of this lesson:** reading, cosine, sine, bearing, ray, code, noise. **Next:** 04, in which two
# wires are enough for a brain.
