# %% [markdown]
# # 19 Your own sensor, actuator, reward
#
# ![A robot that walks sideways like a crab](pictures/19.png)
#
# Everything that you have used so far is a block that somebody wrote. Today you write some that nobody
# has thought of.
#
# **When you have finished, you can**
#
# - write a sensor, an actuator and a reward function, in ten lines each,
# - give a block parameters, with limits that are checked,
# - have your blocks examined, and understand what the examiner says,
# - share a block, so that others can use it in their scenes.
#
# *About 85 minutes. Before: lessons 03 and 09.*
#
# **Recap.** An agent is put together from blocks. Each block has parameters.

# %% tags=["setup"]
from gymnasium.spaces import Box

from ai4u_edu import *
from ai4u_edu.check import check_actuator, check_reward, check_sensor
from ai4u_edu.lessons import check, compare, film, hint, predict, progress, report, show, solution


def world_with_box():
    world = World(seed=1)
    world.add_floor("plate", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 1), tags=("target",))
    return world


# %% [markdown]
# ## A sensor
#
# A block is a **class**: a plan from which objects are built. `class Height(Sensor)` says: a Height is a
# Sensor. Two functions make a sensor out of it:
#
# - `space` says what a reading looks like: `Box(low, high, (how many numbers,))`,
# - `read` gives one reading. It gets the robot's `body`, and a `view` of the world: `view["box"]` is the
#   body called "box".


# %%
class Height(Sensor):
    """How high the agent's feet are above the floor, in metres."""

    highest: float = 5.0

    def space(self):
        return Box(0.0, self.highest, (1,))

    def read(self, body, view):
        return min(max(body.z, 0.0), self.highest)


print(Height())
print(check_sensor(Height()))

# %% [markdown]
# The line `highest: float = 5.0` is a **parameter**: its name, its kind, its default value. The text in
# triple quotes says what the block is for. Never leave it out: the examiner insists on it.
#
# `check_sensor` puts the sensor into worlds and drives around. Is the reading always within the space
# that the sensor promised? Is it the same when everything happens twice? Does it change at all?
#
# ### Exercise 19.1: nearness
#
# Write a sensor `Nearness` that reads **1** right at its target, **0** at `reach` metres and everywhere
# beyond, and falls evenly in between: 0.5 at half the reach. `body.distance(view[self.target])` is the
# distance in metres.


# %% tags=["exercise-19.1"]
class Nearness(Sensor):
    """How near the target is: 1 right at it, 0 at the reach and beyond."""

    target: str
    reach: float = 8.0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        return 0.0


# %%
check("19.1", Nearness)

# %%
print(check_sensor(Nearness(target="box")))

# %% [markdown]
# ## A reward function
#
# It has one function, `on_update`, which is called after each decision and returns the payment. Here is
# one that would suit the dancer of lesson 09:


# %%
class Motion(RewardFunc):
    """Pays for speed."""

    per_metre: float = 1.0

    def on_update(self, body, view):
        vx, vy = body.velocity
        return self.per_metre * (vx**2 + vy**2) ** 0.5 / 12


# %% [markdown]
# ### Exercise 19.2: calm
#
# Write a reward function `Calm`: it pays **-cost** for each decision after which the robot turns faster
# than `limit` radians a second, to either side, and **0** otherwise. `body.angular_velocity` is the
# turning speed: above 0 to the left, below 0 to the right.


# %% tags=["exercise-19.2"]
class Calm(RewardFunc):
    """A cost for turning fast."""

    limit: float = 1.0
    cost: float = 0.1

    def on_update(self, body, view):
        return 0.0


# %%
check("19.2", Calm)

# %% [markdown]
# ## An actuator
#
# It says what an action looks like (`space`), and what it does (`act`). `act` is called at each tick,
# with the action as a list of numbers: `action[0]` is the first one. What it may do with the body:
#
# | | |
# |---|---|
# | `body.apply_force(forward, left)` | a push, in newtons, seen from the body |
# | `body.set_velocity(vx, vy)` | a speed in m/s, seen from the world |
# | `body.set_angular_velocity(omega)` | a turning speed in rad/s, above 0 to the left |
# | `body.jump(speed)` | jumps, with that speed upwards in m/s |
#
# ### Exercise 19.3: a crab
#
# Crabs walk sideways. Write an actuator that takes **one** number from -1 to 1 and pushes the body to its
# **left** with that many times `newtons` (below 0: to its right).


# %% tags=["exercise-19.3"]
class Crab(Actuator):
    """Pushes the body sideways."""

    newtons: float = 20.0

    def space(self):
        return Box(-1.0, 1.0, (1,))

    def act(self, body, action):
        pass


# %%
check("19.3", Crab)

# %% [markdown]
# Put it into a robot. To which side will this one move, left or right? It looks to the right of the picture.

# %%
predict("19.crab", ...)

# %%
crab = BasicAgent(
    body="robot",
    sensors=[Nearness(target="box")],
    actuators=[Crab(newtons=6)],
    rewards=[Calm()],
    brains=[LocalBrain(controller=lambda percept: {"crab": [0.4]})],
)
film(ControlRequestor(world_with_box(), [crab]), limit=40)
compare("19.crab", "left")

# %% [markdown]
# ## Share it
#
# Blocks in a Python file of their own can be used in scene files like built-in ones. Write one:

# %%
from pathlib import Path

Path("my_blocks.py").write_text('''"""My blocks."""

from gymnasium.spaces import Box

from ai4u_edu import Sensor


class Edge(Sensor):
    """How far the agent is from the middle of the world, in metres."""

    def space(self):
        return Box(0.0, 100.0, (1,))

    def read(self, body, view):
        x, y = body.position
        return (x**2 + y**2) ** 0.5
''')
print(Path("my_blocks.py").read_text())

# %% [markdown]
# In a terminal, `ai4u-edu play my_scene.yaml --blocks my_blocks.py` plays a scene that names it: `- type:
# Edge`. Give the file to a friend. But look before you run a file from somebody you don't know: it is a
# program, and a program can do anything.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** Your sensor has the parameter `reach: float = 8.0`. In `read` you write `1 - distance / 8`. A
# friend uses `reach=5`. What happens?
#
# - a: The sensor reads 0 at 5 metres, as your friend wants.
# - b: There is an error, because 5 is not 8.
# - c: It still reads 0 at 8 metres.
#
# **2.** The examiner says that a reading leaves its space. What does that mean?
#
# - a: `read` returned a number that `space` does not allow.
# - b: The robot drove out of the world.
# - c: The sensor is too slow for the world.
#
# **3.** Somebody you don't know sends you a scene file and a file with blocks. Which of them can do harm
# to your computer?
#
# - a: The scene file: it decides what happens in the world.
# - b: The file with blocks: it is a program.
# - c: Neither: both only describe things.

# %% tags=["exercise-19.exit"]
answers = ["", "", ""]

# %%
check("19.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - `unit = "m"` in a sensor's class tells the panel which unit its numbers have. Give it one.
# - A sensor that remembers: `on_reset(self, agent, view)` is called at the beginning of an episode. Write
#   an odometer: how many metres has the robot driven so far?
# - An actuator that costs: let the crab get tired, so that its push gets weaker and weaker.
#
# **Words of this lesson:** class, space, to examine (check), unit. **Next:** you build a world of your
# own.
