# %% [markdown]
# # 05 A vehicle with two wires
#
# ![A vehicle that found the lamp with two wires](pictures/05.png)
#
# Here is a robot whose whole brain is two wires. And yet people who watch it say things like "it is
# afraid", or "it loves the lamp". How much brain does a feeling need?
#
# **When you have finished, you can**
#
# - drive with two wheels,
# - wire sensors straight to motors, and predict what the vehicle will do,
# - make four characters out of two wires,
# - say why what we *see* in a robot is more than what is *in* it.
#
# *About 65 minutes. Before: lesson 04. The exercises can be solved with code, or with sliders.*
#
# **Recap.** A robot knows only what its sensors tell it. The controller turns readings into an action.

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
    sliders,
    solution,
)


def vehicle(wires, x=-5, y=2, heading_deg=0):
    """A vehicle with two eyes and two wheels, and a lamp in the middle."""
    world = World()
    world.add_floor("plate", BoxShape(size=(16, 16)))
    shape = CircleShape(radius=0.5)
    world.add_body("vehicle", shape, position=(x, y), heading_deg=heading_deg)
    world.add_body("lamp", CircleShape(radius=0.4), kind="static", tags=("lamp",), colour="yellow")
    agent = BasicAgent(
        body="vehicle",
        sensors=[
            LightSensor(perception_key="left eye", group="lamp", angle_deg=60, reach=4),
            LightSensor(perception_key="right eye", group="lamp", angle_deg=-60, reach=4),
        ],
        actuators=[
            DifferentialDriveActuator(action_name="wheels", max_wheel_speed=3, axle_width=1)
        ],
        brains=[LocalBrain(controller=wires)],
    )
    return ControlRequestor(world, [agent])


# %% [markdown]
# ## Two wheels
#
# This vehicle has a wheel on each side. The action is `{"wheels": [left, right]}`, each from -1 to 1.
# If both are the same, it drives straight on. If the left wheel is faster, it turns to the ... ? Think of a
# rowing boat, and write `"left"` or `"right"` in place of the dots.

# %%
predict("05.1", ...)


# %%
def try_wheels(percept):
    return {"wheels": [0.6, 0.4]}


film(vehicle(try_wheels), limit=60)
compare("05.1", "right")

# %% [markdown]
# The faster wheel is on the outside of the curve.
#
# **Numbers or choices?** The wheels take any number from -1 to 1. Such an actuator is *continuous*. A
# `DiscreteActuator` is different: its action is a **choice**, one whole number that stands for a line in
# a table. 0 does nothing, 1 turns right, 2 turns left, 3 drives forward, 4 drives backward. Some ways to
# learn can only deal with choices.


# %%
def chooser(percept):
    return {"move": 3 if percept["steps"] % 12 < 8 else 2}


choosing = BasicAgent(
    body="vehicle",
    sensors=[StepSensor()],
    actuators=[DiscreteActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=chooser)],
)
film(ControlRequestor(vehicle(try_wheels).world, [choosing]), limit=48)

# %% [markdown]
# ## Two eyes
#
# A `LightSensor` reads how bright it is: 0 in the dark, up to 1. The left eye looks 60 degrees to the
# left, the right eye 60 degrees to the right. The nearer the lamp, and the more directly the eye looks at
# it, the brighter.

# %%
distances = [0.5 * step for step in range(2, 23)]
left, right = [], []
for distance in distances:
    sim = vehicle(try_wheels, x=-distance, y=0, heading_deg=-30)  # the lamp is a bit to the left
    sim.reset()
    left.append(float(sim.agents[0].percept["left eye"][0]))
    right.append(float(sim.agents[0].percept["right eye"][0]))
plot(
    {"left eye": left, "right eye": right},
    x=distances,
    xlabel="distance to the lamp in metres",
    ylabel="brightness",
)

# %% [markdown]
# ## Wires
#
# Now connect them. A wire carries a brightness from an eye to a wheel: the brighter, the faster. There
# are two ways: each eye to the wheel on **its own** side, or **crossed**, to the wheel on the other side.
#
# Take paper and draw a vehicle from above, with its eyes, wheels and wires, and a lamp at the front
# left. Which eye gets more light? Which wheel turns faster? Where does it go?
#
# ### Exercise 05.1: attack
#
# Wire the vehicle so that it drives into the lamp.


# %% tags=["exercise-05.1"]
def attack(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %%
check("05.1", attack)

# %% [markdown]
# **Without code.** You can also set the wires by hand. Each wheel gets the number `base`, plus `own_side`
# times the brightness of the eye on its own side, plus `crossed` times the brightness of the other eye.
# Run the cell; then **Try** shows what your vehicle does, and **Check** checks the exercise.


# %%
def wires(base, own_side, crossed):
    def controller(percept):
        left_eye = percept["left eye"][0]
        right_eye = percept["right eye"][0]
        left_wheel = base + own_side * left_eye + crossed * right_eye
        right_wheel = base + own_side * right_eye + crossed * left_eye
        return {"wheels": [left_wheel, right_wheel]}

    return controller


sliders("05.1", wires, base=(-1, 1), own_side=(-4, 4), crossed=(-4, 4))

# %%
film(vehicle(attack), limit=120)

# %% [markdown]
# The nearer it comes, the faster it gets. People say: it is *aggressive*.
#
# ### Exercise 05.2: fear
#
# Now build one that turns away from the lamp, and runs forward as long as it sees it. Far away, in the
# dark, it comes to rest.


# %% tags=["exercise-05.2"]
def fear(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %%
check("05.2", fear)

# %% [markdown]
# **Without code:**

# %%
sliders("05.2", wires, base=(-1, 1), own_side=(-4, 4), crossed=(-4, 4))

# %%
film(vehicle(fear, heading_deg=-20), limit=120)

# %% [markdown]
# ## Wires that slow down
#
# A wire can also **brake**: the brighter, the slower. Such a wheel turns fast in the dark, as with
# `1 - 2 * brightness`. (A brake of 2 is too weak: that vehicle runs into the lamp.) In living brains there
# are both kinds of connections, too: those that *excite* and those that *inhibit*.
#
# ### Exercise 05.3: love
#
# Make a vehicle that comes to the lamp and stays in front of it, facing it, **1 to 3.5 metres** away
# (from middle to middle). There are two things to find out: which eye brakes which wheel, and how strongly.


# %% tags=["exercise-05.3"]
def love(percept):
    left_eye = percept["left eye"][0]
    right_eye = percept["right eye"][0]
    return {"wheels": [0, 0]}


# %%
check("05.3", love)

# %% [markdown]
# **Without code:** (a number below 0 brakes)

# %%
sliders("05.3", wires, base=(-1, 1), own_side=(-4, 4), crossed=(-4, 4))

# %%
show(vehicle(love))

# %% [markdown]
# Show your three vehicles to somebody who does not know the wires. Ask: what does it want? What does it
# feel? Then show them the wires.
#
# Valentino Braitenberg, a brain researcher, invented these vehicles in 1984. He called it the law of
# **uphill analysis and downhill invention**: it is easy to build something that behaves in a surprising
# way, and hard to guess from the behaviour what is inside. Remember that when you watch animals, or
# people, or a chatbot.

# %% [markdown]
# ## Try many: how fast can two wires be?
#
# Wires can follow a black line, too. This vehicle has five small eyes close to the ground. One that is above
# the line reads 1, and brakes the wheel on its own side. Now make the wheels faster. `vary` changes one
# number of a scene, and lets the vehicle drive from the same 8 starts with each value. With which speed will
# it lose the line? Guess first.


# %%
def follow(percept):
    eyes = percept["line"]
    left_eyes, right_eyes = eyes[0] + eyes[1], eyes[3] + eyes[4]
    return {"move": [0.5 - 0.4 * left_eyes, 0.5 - 0.4 * right_eyes]}


vary(follow, "line_follow", "max_wheel_speed", [4, 8, 12], episodes=8)

# %% [markdown]
# `success` is how often it drove a whole lap. Eight starts are few, so the next column says where the true
# share probably lies. A faster vehicle needs less **time** for a lap, until it is too fast for its wires. Can
# you wire it better, so that it stays on the line with 12 metres a second?

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A lamp shines from the front left. Each eye is connected to the wheel on its own side: the
# brighter, the faster. What does the vehicle do?
#
# - a: it turns to the right, away from the lamp
# - b: it turns to the left, towards the lamp
# - c: it drives straight on, a little faster
#
# **2.** People say of a vehicle: "It is afraid of the lamp." What do you find inside?
#
# - a: a small program for fear
# - b: a list of things that it should avoid
# - c: two wires, and nothing that means "afraid"
#
# **3.** An actuator takes an action such as `{"move": 3}`, a choice from a table. How many different
# actions does it have?
#
# - a: as many as there are lines in the table
# - b: any number from -1 to 1
# - c: three

# %% tags=["exercise-05.exit"]
answers = ["", "", ""]

# %%
check("05.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - There is a fourth character: brakes the other way round. Braitenberg called it the *explorer*. Why?
# - Put two lamps into the world (`World.add_body` with the tag `"lamp"`). What does each of your vehicles
#   do between them?
# - What happens if one eye breaks (always 0)? Try it, then think of an animal that circles around a lamp
#   at night.
#
# **Words of this lesson:** actuator with two wheels, brightness, to excite, to inhibit. **Next:** 06, in
# which the brain gets rules, and a memory.
