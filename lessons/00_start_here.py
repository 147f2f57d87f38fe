# %% [markdown]
# # 00 Start here
#
# ![A blue robot on a grey plate drives to an orange box](pictures/00.png)
#
# In this course you build robots that live in a small flat world. First you drive them yourself, then you
# tell them how to drive, and in the end they learn it by themselves. It starts with a click.
#
# **When you have finished, you can**
#
# - run a notebook, cell by cell,
# - open the sandbox and drive a robot,
# - send a robot its first action from Python,
# - read an error message and fix the mistake.
#
# *About 45 minutes. All you need is this page.*

# %% [markdown]
# ## Is everything there?
#
# The grey box below is a **cell**: a piece of a program. Click into it, then press **Shift + Enter**. The
# cell runs, and its output appears below it.
#
# Before you run the first cell, wait until you see *Idle* at the bottom of the window. Then you will see
# a robot on a plate. The blue frame means that your keys go to it. (No blue frame? **Click the
# picture**.) Hold **W** to drive forward, **S** to drive backward, **A** and **D** to turn. **R** starts
# again. Reach the orange box, and don't fall off the plate!

# %%
from ai4u_edu.lessons import ready, show

ready()
show("box_chase", seed=1)

# %% [markdown]
# The green box tells you whether everything you need is installed. Can't you see a robot? Click the line
# above the picture: it opens the world in its own tab. If that does not help either, show your teacher
# the output of the cell.
#
# ## What is a notebook?
#
# A notebook is a page of text and cells. Three things to know:
#
# 1. **Shift + Enter** runs a cell and moves on to the next one. The number on the left shows in which
#    order the cells ran.
# 2. Cells remember. The next cell can use what this one made. So run them **from top to bottom**.
# 3. If things get mixed up, choose **Kernel > Restart Kernel**, and run the cells again from the top.
#    Your text stays.
#
# Try it: change the word in quotes, and run the cell. (The two lines above it import what we need later.)

# %% tags=["setup"]
from ai4u_edu import Scene
from ai4u_edu.lessons import check, film, hint, progress, report, solution

name = "Ada"
print("Hello,", name)

# %% [markdown]
# ## Your first action
#
# You drove with keys. A program drives with numbers. Twelve times a second the robot asks: *what
# should I do?* The answer is called an **action**, and it looks like this:
#
# ```python
# {"move": [1, 0, 0, 0]}
# ```
#
# The first number drives, the second one turns. (The other two jump; this robot can't.) Each goes from -1
# to 1. A **function** returns the action; the robot calls it again and again. The function also gets a
# `percept`: everything the robot senses. We don't look at that yet.


# %%
def spin(percept):
    return {"move": [0, 1, 0, 0]}


film("box_chase", spin, seed=1, limit=36)

# %% [markdown]
# `film` runs one **episode** and shows it as a short film. An episode is one try, from the start until
# the robot reaches its goal, falls, or time is up. `limit=36` ends it after 36 decisions: that is three
# seconds.
#
# ### Exercise 00.1: make it go
#
# Write a function that makes the robot drive **forward**. Replace the first 0.


# %% tags=["exercise-00.1"]
def go(percept):
    return {"move": [0, 0, 0, 0]}


# %% [markdown]
# Now find out whether it works. `check` tries your function on robots in several worlds, and tells you
# what happened. Ask as often as you like. If you are stuck, there is a hint; and if nothing helps,
# `solution("00.1")` shows one way to do it.

# %%
check("00.1", go)

# %%
hint("00.1")

# %% [markdown]
# ### Exercise 00.2: turn left
#
# The cell with `spin` turned the robot to the right. Write a function that turns it to the **left**, without
# driving away.


# %% tags=["exercise-00.2"]
def turn_left(percept):
    return {"move": [0, 0, 0, 0]}


# %%
check("00.2", turn_left)

# %% [markdown]
# ## Errors are messages
#
# Everybody's programs stop with errors, every day. The trick is to read the messages. **The last line says
# what is wrong.** The lines above it say where.
#
# The robot only knows an action called `move`. See what happens when we use a different name:


# %%
def wrong(percept):
    return {"mov": [1, 0, 0, 0]}


try:
    film("box_chase", wrong, seed=1)
except Exception as error:
    print(type(error).__name__ + ":", error)

# %% [markdown]
# It even guesses what we meant.
#
# ### Exercise 00.3: fix it
#
# This function should make the robot drive a curve to the right. There are mistakes in it. Run the check,
# read the message, fix one thing, and check again.


# %% tags=["exercise-00.3"]
def curve(percept):
    return {"mvoe": [forward, 0.5, 0, 0]}


# %%
check("00.3", curve)

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** What does this action do? `{"move": [0.5, -1, 0, 0]}`
#
# - a: drives forward and turns left, in a curve
# - b: drives backward and turns right
# - c: drives forward for half a second, then turns left
#
# **2.** You change the function `go` in its cell, but you don't run that cell. Then you run
# `check("00.1", go)`. What is checked?
#
# - a: the new function: it is what the page shows
# - b: nothing: there will be an error
# - c: the old function
#
# **3.** The last line of an error message is `NameError: name 'forward' is not defined`. What does it
# tell you?
#
# - a: the robot can't drive forward
# - b: the program uses a name that stands for nothing yet
# - c: the cell has to be run a second time

# %% tags=["exercise-00.exit"]
answers = ["", "", ""]

# %%
check("00.exit", answers)

# %% [markdown]
# ## How far are you?

# %%
progress()

# %% [markdown]
# `progress()` works in every lesson. Your results are saved in the file `progress.json`, next to your
# notebooks; they go nowhere else. At the end of a lesson `report()` writes a page, `report.html`, which
# you can hand in: it holds your code, what the checks said, and their pictures.

# %%
report()

# %% [markdown]
# ## Stretch
#
# - Make the robot drive a circle that fits on the plate: `film("box_chase", your_function, seed=1)`.
#   Which two numbers make a small circle, and which a large one?
# - `Scene.names()` lists all worlds. Put another name into `show("...")`, and play.

# %%
print(Scene.names())

# %% [markdown]
# **Words of this lesson:** cell, action, percept, decision, episode, seed. They are explained in
# `GLOSSARY.md`. **Next:** 01 if you have never programmed in Python; otherwise 02, in which you find
# out what the robot is told while you drive.
