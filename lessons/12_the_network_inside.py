# %% [markdown]
# # 12 The network inside: numbers, and nothing else
#
# ![A robot's way to a box, driven by two neurons](pictures/12.png)
#
# You have a file that drives better than you do. What is in it? No rule, no "if the box is on the left".
# In this lesson you open it; by the end, a few lines of your own do everything it does.
#
# **When you have finished, you can**
#
# - compute a neuron, a layer and a whole network,
# - set six weights by hand, so that two neurons find a box,
# - multiply a table by a row of numbers with `@`,
# - say why a network needs something that squashes numbers.
#
# *About 65 minutes. Before: lesson 10 or 11. Exercise 12.2 can be solved with code, or with sliders.*
#
# **Recap.** A policy gets a percept and gives an action. Lessons 10 and 11 made networks that are
# policies.

# %% tags=["setup"]
import math

import numpy as np

from ai4u_edu import *
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
from ai4u_edu.lessons.exercises.lesson_12 import (
    by_hand,
    decide,
    first_percept,
    inputs_of,
    layers_of,
    two_neurons,
)

# %% [markdown]
# ## One neuron
#
# A network is made of **neurons**. Each has a **weight** for every input and one more number, its
# **bias**. It multiplies every input by its weight, adds all that up, adds the bias, and squashes the sum
# with `tanh` into the range from -1 to 1:

# %%
sums = [each / 10 for each in range(-40, 41)]
plot({"tanh": [math.tanh(each) for each in sums]}, x=sums, xlabel="sum", ylabel="tanh(sum)")

# %% [markdown]
# There is no sudden switch in this curve, as there is in an `if`. A small change of an input changes the
# output a little. That is why a neuron can learn: you can always ask "a little more, or a little less?"
#
# ### Exercise 12.1: one neuron
#
# Compute its output. `inputs` and `weights` are lists of the same length.


# %% tags=["exercise-12.1"]
def neuron(inputs, weights, bias):
    return 0


# %%
check("12.1", neuron)

# %% [markdown]
# ## Two neurons drive
#
# Two neurons are enough to find a box. Both read the bearing: its sine (above 0: the box is on the left)
# and its cosine (above 0: ahead). The first neuron says how fast to drive, the second how fast to turn
# (above 0: right).
#
# ### Exercise 12.2: two neurons by hand
#
# Set the numbers. The first row belongs to *forward*, the second to *turn*; the first number of a row
# weighs the sine, the second the cosine. Here nobody learns but you.

# %% tags=["exercise-12.2"]
weights = [
    [0, 0],
    [0, 0],
]
bias = [0, 0]

# %%
check("12.2", weights, bias)

# %% [markdown]
# Without code: each slider is one of the six numbers. *Try* shows how the robot drives with them.

# %%
ENDS = (-5, 5)
sliders(
    "12.2",
    two_neurons,
    forward_sine=ENDS,
    forward_cosine=ENDS,
    forward_bias=ENDS,
    turn_sine=ENDS,
    turn_cosine=ENDS,
    turn_bias=ENDS,
)

# %%
film(by_hand(weights, bias), seed=3, limit=150)

# %% [markdown]
# How did you find your numbers? You thought about what each of them means. With six numbers that works.
# Now look into a file. The package comes with some networks that somebody has trained; `zoo:box_chase` is
# one of them. It has two layers of 64 neurons, and one of four. How many numbers are in it?

# %%
predict("12.numbers", ...)

# %%
layers = layers_of("zoo:box_chase")
for table, _ in layers:
    print(table.shape[1], "inputs ->", table.shape[0], "outputs")
print("the first five numbers:", layers[0][0][0, :5].round(3))
compare("12.numbers", sum(w.size + b.size for w, b in layers))

# %% [markdown]
# More than 12,000 numbers, and none of them is "the" rule for turning left. Nobody chose them. Learning
# is turning each of these knobs a little, thousands of times.
#
# ## A table times a row: `@`
#
# Neurons that read the same inputs stand side by side in a **layer**. Your two neurons were one. All
# weights of a layer together are a table (a **matrix**), with one row for each neuron and one column for
# each input.
#
# To get the sums of all neurons, each row of the table has to be multiplied by the inputs, number by
# number, and added up. In Python that is a loop in a loop. NumPy has a sign for it: `@`.

# %%
rows = [[1, 2, 3], [10, 0, 10]]  # two neurons with three inputs each
inputs = [1, 1, 0.5]
print("in Python:", [sum(w * x for w, x in zip(row, inputs)) for row in rows])
table = np.array(rows)
print("with @:   ", table @ inputs)

# %% [markdown]
# Check it by hand: the first row gives 1 · 1 + 2 · 1 + 3 · 0.5 = 4.5, the second 10 · 1 + 0 · 1 + 10 ·
# 0.5 = 15. Three numbers go in, two come out: as many as the table has rows.
#
# - The table stands on the left, the inputs on the right. A row of the table has as many numbers as there
#   are inputs; if not, NumPy complains (it calls that a *mismatch in its core dimension*).
# - `+` adds two arrays number by number: `table @ inputs + bias` gives each neuron its own bias.
# - `np.tanh` squashes each number of an array. `math.tanh` takes one number only.

# %%
bias_of_two = np.array([-4.5, -15.5])
print("sums:   ", table @ inputs + bias_of_two)
print("outputs:", np.tanh(table @ inputs + bias_of_two).round(2))
try:
    table @ np.array([1, 1])
except ValueError as error:
    print("two inputs:", error)

# %% [markdown]
# ## All of it
#
# A network is one layer after the other: the output of a layer is the input of the next one. Between the
# layers everything is squashed by `np.tanh`; the output of the last layer is taken as it is.
#
# Why squash? Without it, a second layer would be of no use. Two tables one after the other can be
# multiplied into a single one, which gives the same output:

# %%
first, second = np.array([[1, 2], [3, 4], [5, 6]]), np.array([[1, 0, -1]])
two_inputs = np.array([0.5, 2])
print("two layers:", second @ (first @ two_inputs), "  one layer:", (second @ first) @ two_inputs)

# %% [markdown]
# ### Exercise 12.3: all of it
#
# Compute the output of a network. `layers` is a list of pairs (weights, bias), the first layer first. The
# check lets your lines drive the robot, with the numbers from the file.


# %% tags=["exercise-12.3"]
def think(inputs, layers):
    weights, bias = layers[-1]
    return np.zeros(len(bias))


# %%
check("12.3", think)

# %% [markdown]
# Compare it with the file, for a percept at the beginning of an episode. The numbers of both rows should
# be the same (except that the file clips them to the actuator's range).

# %%
percept = first_percept()
print("yours:   ", np.round(think(inputs_of(percept), layers), 4))
print("the file:", np.round(decide(percept), 4))

# %% [markdown]
# So a trained robot needs nothing of what it was trained with: no torch, no simulator, no graphics card.
# A loop and a multiplication will do. Networks like this one run on chips that cost less than a bread
# roll.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** A neuron's output is 0.5. You double its weights and its bias. What is its output now?
#
# - a: Exactly 1.
# - b: More than 0.5, but less than 1.
# - c: Still 0.5, because `tanh` squashes everything.
#
# **2.** A layer's table has 3 rows and 5 columns. What goes in and out?
#
# - a: 5 numbers go in, 3 come out.
# - b: 3 numbers go in, 5 come out.
# - c: 15 numbers go in, 1 comes out.
#
# **3.** Somebody leaves out `np.tanh` between the layers of a network. What can it still do?
#
# - a: Everything, only with larger numbers.
# - b: Nothing: there is an error.
# - c: No more than a network with a single layer.

# %% tags=["exercise-12.exit"]
answers = ["", "", ""]

# %%
check("12.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Put your own `think` into a `LocalBrain(controller=..., skip_frame=9)`, and race it against
#   `"zoo:box_chase"` on the `track` of lesson 11. Who should win?
# - Round all weights to one decimal: `[(w.round(1), b.round(1)) for w, b in layers]`. Does it still
#   drive? And without decimals?
# - Set a whole row of the first layer to 0, as if a neuron had died. How many may die?
# - Read how such a network learns: `ai4u_edu/learn/small/neural_network.py`, 200 lines. `forward` is your
#   `think`, for many percepts at once; `backward` says which way each number should move.
#
# **Words of this lesson:** neuron, weight, bias, tanh, layer, matrix. **Next:** 13, in which you put
# networks into robots, and find out what they look at.
