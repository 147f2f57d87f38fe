# %% [markdown]
# # 01 Python for robots
#
# ![A robot that found the way to a lamp](pictures/01.png)
#
# A robot does exactly what its program says. So you need to say it exactly. Today you learn the part of
# Python that the whole course is made of. It is smaller than you might think.
#
# **When you have finished, you can**
#
# - keep values in variables, and compute with them,
# - write a function that returns its result,
# - let a program choose with `if`, `elif` and `else`,
# - work through a list with a `for` loop,
# - find a mistake with the help of its error message.
#
# *About 75 minutes; a class can stop after 01.3. Before: lesson 00. If you have programmed in Python
# before, go straight to the exercises; if they are easy, go on to the next lesson.*
#
# **Recap.** Shift + Enter runs a cell. A robot calls a function twelve times a second and asks what to do.

# %% tags=["setup"]
from ai4u_edu.lessons import check, compare, film, hint, predict, progress, report, solution

# %% [markdown]
# ## Variables
#
# A **variable** is a name for a value. `=` puts the value on its right under the name on its left. Read
# it as "becomes": speed becomes 2.

# %%
speed = 2
seconds = 3
distance = speed * seconds
print("distance:", distance)

# %% [markdown]
# `*` multiplies, `/` divides, and `+` and `-` do what you think. Python works from top to bottom: when the
# third line runs, it computes `distance` once, with the values of that moment. What happens if `speed`
# changes *afterwards*? In a moment we make `speed` 4 and print `distance` once more. Which number will
# appear? Put your guess in place of the three dots.

# %%
predict("01.1", ...)

# %%
speed = 4
print("distance:", distance)

# %%
compare("01.1", distance)

# %% [markdown]
# The name `distance` still stands for the number 6. Nobody computed it again.
#
# A value can also be a text, which Python calls a *string*. It stands in quotes: `name = "Ada"`. Quotes
# make the difference: `"speed"` is a word with five letters, `speed` is a variable.
#
# ## Functions
#
# A **function** is a small program with a name. `def` defines it, and the names in brackets,
# its *parameters*, stand for what it is given. The lines that belong to it are **indented**: moved to the
# right by four spaces.
#
# `return` is the function's answer. The function ends there, and the answer goes to whoever called it:


# %%
def way(speed, seconds):
    metres = speed * seconds
    return metres


print(way(2, 3))
print(way(0.5, 10) + 1)

# %% [markdown]
# **`return` and `print` are not the same.** `print` writes something on the page, for *you* to read.
# `return` gives a value back to the *program*. A robot can't read the page. A function that only prints
# returns nothing, and Python calls nothing `None`:


# %%
def way_printed(speed, seconds):
    print(speed * seconds)


result = way_printed(2, 3)
print("the program got:", result)

# %% [markdown]
# ### Exercise 01.1: how fast?
#
# A robot has to be at a line in time. The line is `distance` metres away, and the robot has `seconds`
# seconds. Return the speed that it needs, in metres a second.


# %% tags=["exercise-01.1"]
def speed_for(distance, seconds):
    return 0


# %%
check("01.1", speed_for)

# %%
hint("01.1")

# %% [markdown]
# ## Choosing: if, elif, else
#
# A robot has to do different things at different times. `if` asks a question. If the answer is yes, the
# indented lines below it run. `elif` (*else if*) asks another question, but only if all answers before it
# were no. `else` is for everything that is left.


# %%
def advice(battery):
    if battery > 50:
        return "play"
    elif battery > 20:
        return "go home"
    else:
        return "sleep"


print(advice(80), "/", advice(35), "/", advice(5))

# %% [markdown]
# 80 is above 50 and above 20. Yet the function says "play" only: **the first question that fits
# decides**, and the others are not asked. So the order matters.
#
# These are the ways to compare two values:
#
# | | | | |
# |---|---|---|---|
# | `a == b` | the same | `a != b` | not the same |
# | `a > b` | greater | `a < b` | less |
# | `a >= b` | greater or the same | `a <= b` | less or the same |
#
# **One `=` or two?** `speed = 2` *makes* speed 2. `speed == 2` *asks* whether it is 2. If you write one `=`
# after `if`, Python refuses to run the cell:
#
# ```
#     if speed = 2:
#        ^^^^^^^^^
# SyntaxError: invalid syntax. Maybe you meant '==' or ':=' instead of '='?
# ```
#
# ### Exercise 01.2: left, right, ahead
#
# A robot looks for a box. At each decision it calls your function and tells it, in a word, on which side
# the box is: `"left"`, `"right"` or `"ahead"`. Return how the robot should turn: **-1** turns left, **1**
# turns right, **0** does not turn. (It drives by itself when the box is ahead.)


# %% tags=["exercise-01.2"]
def turn_for(side):
    return 0


# %%
check("01.2", turn_for)

# %% [markdown]
# ## What the robot senses
#
# In lesson 00 your functions got a `percept` and did not look at it. It is a *dictionary*: it holds
# values under names. `percept["light"]` is the reading of the sensor called `light`. Most readings are
# lists of several numbers, even when there is only one, and `[0]` takes the first:


# %%
percept = {"light": [0.35], "bearing": [0.6, 0.8]}
print(percept["light"])
print(percept["light"][0])
print(percept["bearing"][1])

# %% [markdown]
# Python counts from 0. So `[0]` is the first number of a list, and `[1]` the second.
#
# ### Exercise 01.3: the moth
#
# A moth flies straight towards a lamp. Its eye tells it how bright it is, from 0 (dark) to 1. The moth is
# fast in the dark, slow where it is brighter, and stops close to the lamp:
#
# | brightness | first number of the action |
# |---|---|
# | above 0.7 | 0 |
# | above 0.2, up to 0.7 | 0.4 |
# | up to 0.2 | 1 |


# %% tags=["exercise-01.3"]
def moth(percept):
    brightness = percept["light"][0]
    return {"move": [0, 0, 0, 0]}


# %%
check("01.3", moth)

# %% [markdown]
# ## Lists and loops
#
# A **list** keeps several values in order. `len` says how many there are, and `append` adds one at the end:

# %%
distances = [3.5, 1.5, 4.0, 2.0]
distances.append(2.5)
print(len(distances), "distances, the first is", distances[0])

# %% [markdown]
# A **`for` loop** does something with each value of a list. The indented lines run once for each
# value. The variable after `for` stands for the first value, then for the second, and so on:

# %%
total = 0
for distance in distances:
    total = total + distance
    print("now", distance, "- so far", total)
print("mean:", total / len(distances))

# %% [markdown]
# `total = total + distance` looks strange if you read `=` as "is the same as". Read it as "becomes": the
# new total becomes the old one plus this distance. `total = 0` stands *before* the loop, because it should
# happen only once. The last line is not indented, so it runs once too, when the loop is over.
#
# ### Exercise 01.4: how many are near?
#
# Posts stand around a robot. You get a list of their distances in metres. Return how many of them are
# **nearer than 2 metres**. You need a loop, with an `if` in it.


# %% tags=["exercise-01.4"]
def count_near(distances):
    count = 0
    return count


# %%
check("01.4", count_near)

# %% [markdown]
# If you want to do something a number of times, use `range`: `range(3)` gives 0, 1 and 2. Those are three
# numbers. (If you don't need the number itself, you can call it `_`.)

# %%
cheer = []
for _ in range(3):
    cheer.append("hip")
cheer.append("hooray")
print(cheer)

# %% [markdown]
# ### Exercise 01.5: a plan
#
# This robot carries out a **plan**: a list of words. `"forward"` drives one metre ahead, `"left"` and
# `"right"` turn by a quarter turn on the spot. A flag stands `ahead` metres in front of the robot and then
# `left` metres to its left. Return a plan that leads to the flag. For `plan(2, 1)` that is
#
# ```python
# ["forward", "forward", "left", "forward"]
# ```


# %% tags=["exercise-01.5"]
def plan(ahead, left):
    steps = []
    return steps


# %%
check("01.5", plan)

# %% [markdown]
# ## Why a robot's function has no `while`
#
# There is another loop: `while` repeats its lines as long as something is true. It is tempting to write
# "drive *while* it is dark":
#
# ```python
# def moth(percept):
#     while percept["light"][0] < 0.7:
#         action = {"move": [1, 0, 0, 0]}
#     return action
# ```
#
# This robot will never move. The world stands still until your function has answered. The percept can't
# change while you wait, so it stays dark, and the loop never ends. The robot calls your function again in
# a twelfth of a second anyway: *that* is the loop. So use `if`, decide about this one moment, and return.
# (`for` is fine: it ends when the list ends.)
#
# ## Reading errors
#
# An error message has three parts that matter. The **last line** says what is wrong. The line with the
# **arrow** says where. And the first word of the last line names the kind of mistake:
#
# | kind | what it means | what to look at |
# |---|---|---|
# | `NameError` | there is no variable of this name | spelling; did its cell run? |
# | `KeyError`, `NameNotFoundError` | there is no entry of this name | spelling of the word in quotes |
# | `IndexError` | the list is not that long | Python counts from 0 |
# | `TypeError` | this can't be done with such values | is one of them a text, a list, `None`? |
# | `SyntaxError` | this isn't valid Python | brackets, colons, quotes, `=` or `==` |
#
# And then there are mistakes **without** a message: the program runs, but does the wrong thing. Then
# `print` helps: put it into your function, and look at what the function really gets.
#
# ### Exercise 01.6: to the lamp
#
# This robot has two eyes. It should turn to the side where it is brighter, and so get to the lamp. There
# are four mistakes in the function. Three of them give an error, and one does not. Run the check, read the
# last line, fix **one** thing, and check again.


# %% tags=["exercise-01.6"]
def to_the_lamp(percept):
    turns = [-0.5, 0, 0.5]  # left, straight on, right
    left = percept["left eye"][0]
    right = percept["rigth eye"][0]
    if left > rihgt:
        turn = turns[0]
    elif left < right:
        turn = turns[3]
    else:
        turn = turns[1]
    return {"move": [turn, 0.5, 0, 0]}


# %%
check("01.6", to_the_lamp)

# %% [markdown]
# That is all the Python you need for now. Two things will come later, when you need them: how to give
# a robot a memory, and how to write blocks of your own.

# %% [markdown]
# ## Exit ticket
#
# **1.** A student wrote this function for exercise 01.1. What does the robot get from it?
#
# ```python
# def speed_for(distance, seconds):
#     print(distance / seconds)
# ```
#
# - a: the right speed
# - b: nothing: `None`
# - c: the right speed, as a text
#
# **2.** What does `grade(90)` return?
#
# ```python
# def grade(points):
#     if points > 30:
#         return "passed"
#     elif points > 80:
#         return "very good"
#     else:
#         return "failed"
# ```
#
# - a: `"very good"`
# - b: first `"passed"`, then `"very good"`
# - c: `"passed"`
#
# **3.** What is `n` after these lines?
#
# ```python
# n = 0
# for distance in [5, 1, 3]:
#     if distance > 2:
#         n = n + 1
# ```
#
# - a: 2
# - b: 8
# - c: 3

# %% tags=["exercise-01.exit"]
answers = ["", "", ""]

# %%
check("01.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Write `plan_square(side)`: a plan that drives a square and ends where it began. One loop can hold
#   another one.
# - `min(distances)` gives the smallest number of a list. Write it yourself, with a `for` loop:
#   `nearest(distances)`. Which value does your variable have before the loop?
# - What do `7 // 2` and `7 % 2` give? Try some more numbers, and find the rule.
#
# **Words of this lesson:** variable, function, parameter, to return, list, loop. **Next:** 02, in which
# you find out what the robot is told while you drive.
