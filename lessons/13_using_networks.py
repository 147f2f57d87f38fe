# %% [markdown]
# # 13 Using networks: a brain from a file
#
# ![A robot's way along a line, driven by a network](pictures/13.png)
#
# Somebody trained a network for a week, and put it on the web as a file. In this lesson you put such
# files into robots, find out what a network looks at, and see what happens when it does not fit.
#
# **When you have finished, you can**
#
# - say what goes into a network file, and what comes out,
# - drive a robot with a `NeuralNetController`, at the right speed of decisions,
# - measure which readings a network listens to,
# - understand the messages when a network and a robot don't match.
#
# *About 65 minutes. Before: lesson 12.*
#
# **Recap.** A network is layers of neurons: numbers to multiply and add, and something that squashes
# them.

# %% tags=["setup"]
import numpy as np

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
)
from ai4u_edu.lessons.exercises.lesson_12 import decide, first_percept
from ai4u_edu.lessons.exercises.lesson_13 import blinded, percepts_of, put_to
from ai4u_edu.lessons.rollouts import drives

# %% [markdown]
# ## A file that drives
#
# A network is a file that ends in `.onnx`. **ONNX** is a format that nearly all programs that train
# networks can write, and nearly all that run them can read. Nothing in it can be run like a program: it
# holds numbers, and the order in which to multiply and add them. So it is safe to use one from somebody
# else.
#
# `NeuralNetController` is the controller that asks such a file. It goes into a `LocalBrain`, like your
# own controllers. `zoo:box_chase` is a file of the **zoo**: the networks that come with the package.

# %%
controller = NeuralNetController(model_path="zoo:box_chase")
network = controller.network
for port in network.inputs:
    print("in: ", port.name, port.shape)
for port in network.outputs:
    print("out:", port.name, port.shape)
print("learned by", network.about["algorithm"], "in", network.about["steps"], "steps")

# %% [markdown]
# The inputs have the names of sensors. `vision` is a block of 4 moments, 2 numbers a ray, 3 rows and 5
# columns of rays. Together with the other readings, how many numbers go in?

# %%
predict("13.inputs", ...)  # your guess, in place of the three dots

# %%
compare("13.inputs", sum(int(np.prod(port.shape)) for port in network.inputs))

# %% [markdown]
# Out come 4: forward, turn, jump, forward jump.
#
# ## How often it is asked
#
# When this network learned, it decided every 10 ticks, six times a second. It got used to how far the
# robot comes in that time. The file remembers the rhythm:

# %%
print("ticks that it skipped between two decisions:", network.about["skip_frame"])

# %% [markdown]
# What if it is asked more often, or less often? Here is the network of another scene, which learned with
# `skip_frame=14`. If you say nothing, a `LocalBrain` has `skip_frame=4`.


# %%
def seconds_to_goal(skip_frame):
    controller = NeuralNetController(model_path="zoo:sample_scene", repeat=False)
    brain = LocalBrain(controller=controller, skip_frame=skip_frame)
    return sum(each.sim.world.time for each in drives("sample_scene", brain, list(range(20)))) / 20


bars(
    {f"skip_frame={each}": seconds_to_goal(each) for each in (4, 14, 19)},
    ylabel="seconds to the goal",
)

# %% [markdown]
# ### Exercise 13.1: a brain for each file
#
# Return a brain that asks the network at `path`, as often as when it learned. The check gives you the
# paths of three networks, with three rhythms.


# %% tags=["exercise-13.1"]
def driver(path):
    controller = NeuralNetController(model_path=path)
    return controller


# %%
check("13.1", driver)

# %% [markdown]
# That is what `trained_brain(path)` does. From now on you may use it.

# %%
film("line_follow", trained_brain("zoo:line_follow"), seed=1, limit=200)

# %% [markdown]
# ## What does it look at?
#
# Take a real percept, and ask the network. Then change one input: the cosine of the direction to the box.
# 1 is straight ahead, -1 is straight behind. What will *forward* be when the box is straight behind: about 1
# (full speed ahead), about 0, or about -1 (full speed backward)?

# %%
predict("13.behind", ...)

# %%
percept = first_percept()
cosines = [each / 20 for each in range(-20, 21)]
actions = [decide(percept, orientation=[cosine, 0.3]) for cosine in cosines]
plot(
    {"forward": [each[0] for each in actions], "turn": [each[1] for each in actions]},
    x=cosines,
    xlabel="cosine of the direction to the box",
    ylabel="action",
)
compare("13.behind", round(actions[0][0]))

# %% [markdown]
# A plot shows one percept and one input. To find out what a network looks at in general, take a whole
# reading away: fill it with zeros, and see how much the action changes.
#
# ### Exercise 13.2: what it looks at
#
# `ask(percept)` gives an action: a list of four numbers, the second one is *turn*. Return by how much the
# turn changes if the reading `key` is all zeros. It should not matter to which side. `{**percept,
# "vision": x}` is a new percept: a copy of the old one, with another `vision`.


# %% tags=["exercise-13.2"]
def influence(ask, percept, key):
    return ask(percept)[1] - ask(percept)[1]


# %%
check("13.2", influence)

# %%
percepts = percepts_of("box_chase", count=50)
bars(
    {
        key: sum(influence(decide, each, key) for each in percepts) / len(percepts)
        for key in ("vision", "orientation", "last_action")
    },
    ylabel="change of turn, mean of 50 percepts",
)

# %% [markdown]
# So the rays matter most for turning, and the direction to the box comes next. Can the network do without
# one of them? Let it drive with zeros in place of a reading, in 20 worlds each. In how many will it reach
# the box without `vision`, without `orientation`, without `last_action`, without the first two?

# %%
predict("13.blind", [..., ..., ..., ...])


# %%
def worlds_won(*keys):
    worlds = list(range(20))
    return sum(each.won for each in drives("box_chase", blinded(*keys), worlds, limit=100))


takes_away = [("vision",), ("orientation",), ("last_action",), ("vision", "orientation")]
compare("13.blind", [worlds_won(*keys) for keys in takes_away])

# %%
film("box_chase", blinded("orientation"), seed=1, limit=100)

# %% [markdown]
# Each of the two makes up for the other, more or less. Without its rays the robot falls now and then:
# nothing tells it where the edge is. Without the direction it looks for the box ten times as long. Only
# without both it is lost. Influence on one action and need for the task are two things: measure both.
#
# ## When it does not fit
#
# A network that learned with one robot can drive another one, if that one has the same sensors and the
# same actuator. If not, it says so before anything moves:

# %%
try:
    put_to([OrientationSensor(target="box")]).reset()
except AI4UError as error:
    print(error)

# %% [markdown]
# ### Exercise 13.3: sensors that fit
#
# Return sensors that read the same numbers as those with which the network learned. The message tells you
# what is missing; `network.about["sensors"]` says what the sensors were like:

# %%
for key, about in network.about["sensors"].items():
    print(key, about, "\n")


# %% tags=["exercise-13.3"]
def senses():
    return [OrientationSensor(target="box")]


# %%
check("13.3", senses)

# %% [markdown]
# Shapes are checked for you; what the numbers *mean* is not. Leave out the angles of the ray sensor, or
# swap the two codes: everything fits, the network does not complain, and the robot still finds the box
# most of the time. But it is told something else than it believes, and one day that matters. Our check
# compares the readings; with a real robot nobody does. That makes it the more dangerous mistake.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** A network learned with `skip_frame=14`. You put it into a brain with `skip_frame=4`. What
# happens?
#
# - a: There is an error message.
# - b: It gets used to the new rhythm after a while.
# - c: It drives, perhaps worse than it could.
#
# **2.** Two codes of the ray sensor are swapped: boxes look like floor to the network, and floor like
# boxes. Who notices?
#
# - a: Nobody, unless somebody looks at how it drives.
# - b: The `NeuralNetController`: it says which sensor is wrong.
# - c: The network: it refuses numbers that it doesn't know.
#
# **3.** With zeros in place of `vision` the turn changes a lot. What follows?
#
# - a: The network can't do its task without `vision`.
# - b: The network uses `vision` to turn. A test shows whether it needs it.
# - c: The other readings are useless.

# %% tags=["exercise-13.exit"]
answers = ["", "", ""]

# %%
check("13.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Fill only a part of `vision` with zeros: the distances, the upper row, the three older moments. What
#   can the network do without?
# - Put the network of `box_chase` into `box_chase_ai4u`, and the other way round. Which one is the better
#   guest?
# - `ai4u-edu play donut --brain zoo` lets a network drive in the page. Press a key to take over, let it
#   go again, and see whether it copes with where you left it.
#
# **Words of this lesson:** ONNX, zoo, NeuralNetController, influence. **Next:** 14 if you want to
# know how learning works inside; otherwise 15, in which your script drives a robot on another machine.
