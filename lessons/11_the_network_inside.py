# %% [markdown]
# # 11 The network inside: numbers, and nothing else
#
# ![A robot's way to a box, driven by two neurons](pictures/11.png)
#
# You have a file that drives better than you do. What is in it? No rule, no "if the box is on the left".
# In this lesson you open it; by the end, a few lines of your own do everything it does.
#
# **When you have finished, you can**
#
# - say what goes into a network and what comes out,
# - compute a neuron, a layer and a whole network,
# - set six weights by hand, so that two neurons find a box,
# - understand the messages when a network and a robot don't match.
#
# *About 95 minutes. Before: lesson 09 or 10. It helps to have seen what `@` does in NumPy.*
#
# **Recap.** A policy gets a percept and gives an action. Lessons 09 and 10 made networks that are policies.

# %% tags=["setup"]
import math

import numpy as np

from ai4u_edu import *
from ai4u_edu.lessons import check, film, hint, plot, progress, report, show, solution
from ai4u_edu.lessons.exercises.lesson_11 import (
    by_hand,
    decide,
    first_percept,
    inputs_of,
    layers_of,
    put_to,
)

# %% [markdown]
# ## From outside
#
# A network is a file that ends in `.onnx`. **ONNX** is a format that nearly all programs that train
# networks can write, and nearly all that run them can read. Nothing in it can be run like a program: it
# holds numbers, and the order in which to multiply and add them. So it is safe to use one from somebody
# else.
#
# `trained_brain("zoo:box_chase")` is a LocalBrain that asks such a file. The **zoo** is a set of networks
# that comes with the package. What does this one read, and what does it return?

# %%
brain = trained_brain("zoo:box_chase")
network = brain.controller.network
for port in network.inputs:
    print("in: ", port.name, port.shape)
for port in network.outputs:
    print("out:", port.name, port.shape)
print("learned by", network.about["algorithm"], "in", network.about["steps"], "steps")

# %% [markdown]
# The inputs have the names of sensors. `vision` is a block of 4 moments, 2 numbers a ray, 3 rows and 5
# columns of rays; how many numbers is that? Together with the others 126 numbers go in, and 4 come out:
# forward, turn, jump, forward jump.
#
# ## Change one input
#
# Take a real percept, and ask the network. Then change one input: the cosine of the direction to the box.
# 1 is straight ahead, -1 is behind. What do you expect it to do when the box is behind?

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

# %% [markdown]
# A small change of an input changes the action a little. There is no sudden switch in it, as in an `if`.
# That is why it can be learned: you can always ask "a little more or a little less?"
#
# ## One neuron
#
# A network is made of **neurons**. Each has a **weight** for every input and one more number, its
# **bias**. It multiplies every input by its weight, adds all that up, adds the bias, and squashes the sum
# with `tanh` into the range from -1 to 1:

# %%
sums = [each / 10 for each in range(-40, 41)]
plot({"tanh": [math.tanh(each) for each in sums]}, x=sums, xlabel="sum", ylabel="tanh(sum)")

# %% [markdown]
# ### Exercise 11.1: one neuron
#
# Compute its output. `inputs` and `weights` are lists of the same length.


# %% tags=["exercise-11.1"]
def neuron(inputs, weights, bias):
    return 0


# %%
check("11.1", neuron)

# %% [markdown]
# ## Two neurons drive
#
# Two neurons are enough to find a box. Both read the bearing: its sine (above 0: the box is on the left)
# and its cosine (above 0: ahead). The first neuron says how fast to drive, the second how fast to turn
# (above 0: right).
#
# ### Exercise 11.2: two neurons by hand
#
# Set the numbers. The first row belongs to *forward*, the second to *turn*; the first number of a row
# weighs the sine, the second the cosine. Here nobody learns but you.

# %% tags=["exercise-11.2"]
weights = [
    [0, 0],
    [0, 0],
]
bias = [0, 0]

# %%
check("11.2", weights, bias)

# %%
film(by_hand(weights, bias), seed=3, limit=150)

# %% [markdown]
# How did you find your numbers? You thought about what each of them means. With six numbers that works.
# Now look into the file:

# %%
layers = layers_of("zoo:box_chase")
for table, _ in layers:
    print(table.shape[1], "inputs ->", table.shape[0], "outputs")
print(
    sum(w.size + b.size for w, b in layers),
    "numbers; the first five:",
    layers[0][0][0, :5].round(3),
)

# %% [markdown]
# More than 12,000 numbers, and none of them is "the" rule for turning left. Nobody chose them. Learning is
# turning each of these knobs a little, thousands of times.
#
# ## All of it
#
# Neurons that read the same inputs stand side by side in a **layer**. All weights of a layer together are
# a table (a *matrix*) with one row for each neuron. NumPy computes all their sums at once: `weights @
# inputs + bias`. Here `@` multiplies each row by the inputs, number by number, and adds up: the same as
# `[sum(w * x for w, x in zip(row, inputs)) for row in weights]`. The output of a layer is the input of
# the next one. Between the layers everything is squashed by `np.tanh`; the output of the last layer is
# taken as it is.
#
# ### Exercise 11.3: all of it
#
# Compute the output of a network. `layers` is a list of pairs (weights, bias), the first layer first. The
# check lets your lines drive the robot, with the numbers from the file.


# %% tags=["exercise-11.3"]
def think(inputs, layers):
    weights, bias = layers[-1]
    return np.zeros(len(bias))


# %%
check("11.3", think)

# %% [markdown]
# Compare it with the file, for the percept from above. The numbers of both rows should be the same
# (except that the file clips them to the actuator's range).

# %%
print("yours:   ", np.round(think(inputs_of(percept), layers), 4))
print("the file:", np.round(decide(percept), 4))

# %% [markdown]
# So a trained robot needs nothing of what it was trained with: no torch, no simulator, no graphics card. A
# loop and a multiplication will do. Networks like this one run on chips that cost less than a bread roll.
#
# ## When it does not fit
#
# A network that learned with one robot can drive another one, if that one has the same sensors and the same
# actuator. If not, it says so before anything moves:

# %%
try:
    put_to([OrientationSensor(target="box")]).reset()
except AI4UError as error:
    print(error)

# %% [markdown]
# ### Exercise 11.4: sensors that fit
#
# Return sensors that read the same numbers as those with which the network learned. The message tells you
# what is missing; `network.about["sensors"]` says what the sensors were like:

# %%
for key, about in network.about["sensors"].items():
    print(key, about, "\n")


# %% tags=["exercise-11.4"]
def senses():
    return [OrientationSensor(target="box")]


# %%
check("11.4", senses)

# %% [markdown]
# Shapes are checked for you; what the numbers *mean* is not. Leave out the angles of the ray sensor, or swap
# the two codes: everything fits, the network does not complain, and the robot still finds the box most of
# the time. But it is told something else than it believes, and one day that matters. Our check compares the
# readings; with a real robot nobody does. That makes it the more dangerous mistake.

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Put your own `think` into a `LocalBrain(controller=..., skip_frame=9)`, and race it against
#   `"zoo:box_chase"` on the `track` of lesson 10. Who should win?
# - Round all weights to one decimal: `[(w.round(1), b.round(1)) for w, b in layers]`. Does it still drive?
#   And without decimals?
# - Set a whole row of the first layer to 0, as if a neuron had died. How many may die?
#
# **Words of this lesson:** ONNX, zoo, neuron, weight, bias, tanh, layer, matrix. **Next:** 12, in which
# agents meet.
