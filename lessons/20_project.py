# %% [markdown]
# # 20 Project: your own world
#
# ![A world of your own, and the way through it](pictures/20.png)
#
# You have driven in worlds that others made, and found out what makes their creatures tick. Now you make
# one yourself: a place, a task, and an agent that can do it.
#
# **When you have finished, you can**
#
# - describe a world in a scene file that others can play,
# - set a task that is neither impossible nor solved by chance,
# - show with numbers that your agent can do it,
# - present your work, with its limits.
#
# *Three to five hours, alone or in pairs. Before: all lessons that your idea needs.*
#
# **Recap.** Body, sensors, actuators, rewards, brain. A reward asks for what it says, not for what you
# meant.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.check import check_scene
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
from ai4u_edu.lessons.exercises.lesson_20 import won_by_chance

# %% [markdown]
# ## An idea
#
# Write it down in three sentences, before you write any code:
#
# 1. **Who** lives there, and what does it want?
# 2. **What makes it hard?** (a wall, an edge, another agent, hunger, a poor sensor ...)
# 3. **How can we tell** that it succeeded?
#
# Ideas to steal: a postman who visits three houses in the right order; a sheepdog that pushes a ball into
# a pen; a thief who must not be seen by the guard; a ferry over a gap; a maze in the dark.
#
# ## The scene file
#
# A scene is a text in a format called YAML: names and values, and indents that say what belongs where.
# You have seen many of them at work. Here is one to begin with. Change it piece by piece, and play it
# after each change.


# %% tags=["exercise-20.1"]
my_scene = """
name: my_world
title: My world
goal: Say in a sentence what is to be done.
controls: W forward, S backward, A left, D right, R restart
rewards: Say what is paid for.
floors:
  - name: plate
    shape: {type: box, size: [10, 10]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    tags: [agent]
    colour: blue
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
    tags: [target]
    colour: orange
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: []
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards: []
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""

# %% [markdown]
# ### Exercise 20.1: a complete scene
#
# It is complete when it has a goal, controls and rewards in words; an agent with at least two sensors, an
# actuator and two reward functions; and `success:` names the reward that is paid when the task is done.
# Something has to be different in each episode: give the robot, or the target of its task, a `random:`.
#
# If there is a mistake in the text, the message names the line.

# %%
check("20.1", my_scene)

# %%
try:
    show(Scene.loads(my_scene))
except AI4UError as error:
    print(error)

# %% [markdown]
# ## An agent that can do it
#
# A task that nobody can do is no task. Write a controller that solves your world, from its percept alone.
#
# ### Exercise 20.2: solved
#
# Your controller has to succeed with at least 8 of 10 seeds.


# %% tags=["exercise-20.2"]
def solve(percept):
    return {"move": [0, 0, 0, 0]}


# The check needs the scene as well. If you change it above, run that cell again.
played_scene = globals().get("my_scene", "")

# %%
check("20.2", played_scene, solve)

# %% [markdown]
# ## Not by chance
#
# A task that everybody can do is no task either. In how many of 10 episodes would somebody succeed in
# your world by pressing keys at random?

# %%
predict("20.chance", ...)

# %%
try:
    compare("20.chance", won_by_chance(my_scene))
except AI4UError as error:
    print(error)

# %% [markdown]
# ### Exercise 20.3: worth something
#
# With random actions, fewer than 3 of 10 episodes may succeed; with your `solve` of 20.2, at least 6.
# Hand in your scene again. If it is too easy, what could you change? The place, the time, the number of
# things to do?


# %% tags=["exercise-20.3"]
hard_scene = """
name: too_easy
title: Too easy
goal: Touch the box.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box
success: touch
floors:
  - name: plate
    shape: {type: box, size: [5, 5]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [1.1, 0]
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards: [{type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""
solver = globals().get("solve", lambda percept: {})  # yours, of exercise 20.2

# %%
check("20.3", hard_scene, solver)

# %% [markdown]
# ## Save it, show it
#
# `Scene.loads(my_scene).save("my_world.yaml")` writes the file. Others play it with `ai4u-edu play
# my_world.yaml`. And `report()` puts your lessons into one page that you can hand in.
#
# ## How it is judged
#
# | | 1 point | 2 points | 3 points |
# |---|---|---|---|
# | idea | a copy with other numbers | an idea of your own | one that surprises |
# | world | can be played | looks clear, the goal can be seen | fun for others to play |
# | agent | solves it sometimes | 8 of 10 | 8 of 10 with as few sensors as possible |
# | rewards | are paid | can't be tricked | you show who tried to trick them |
# | evidence | "it works" | numbers over many seeds | numbers, a comparison, a plot |
# | honesty | - | says where it fails | says why, and what would help |
#
# Present it in five minutes: let somebody play it first, then show your agent, then where it fails.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** An agent succeeds in 10 of 10 episodes. All of them had the seed 1. What does that show?
#
# - a: That it succeeds every time.
# - b: That it succeeds in one episode.
# - c: That it is better than chance.
#
# **2.** Random actions succeed in 7 of 10 episodes, your agent in 8 of 10. What do you conclude?
#
# - a: The task is too easy to show what the agent can do.
# - b: The agent is good: 8 of 10 is a lot.
# - c: The agent is a bit better than chance.
#
# **3.** You improved your controller until it won with all seeds from 0 to 9. With which seeds do you
# measure how good it is?
#
# - a: With 0 to 9: with those it can be compared with earlier versions.
# - b: With those of 0 to 9 that are hardest.
# - c: With others, which it was not improved on.

# %% tags=["exercise-20.exit"]
answers = ["", "", ""]

# %%
check("20.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Train a network in your world (lesson 10): `ai4u-edu train my_world.yaml`. Is it better than your
#   controller? Is it better than you?
# - Add a second agent, and make them rivals or friends (lesson 16).
# - Swap worlds with somebody, and write a controller for theirs.
#
# **Words of this lesson:** scene file, YAML, chance level, evidence. If you have done 21,
# "Traces and signals", you have been through all lessons: congratulations.
