# %% [markdown]
# # 10 Learn from yourself: five drives are enough
#
# ![Two robots race to a box that stands between them](pictures/10.png)
#
# A baby does not find out by chance how to use a spoon. It watches. In this lesson you show a robot how
# you drive, five times, and a network learns to do the same. Then it races against the network that nobody
# has shown anything.
#
# **When you have finished, you can**
#
# - record what you drive, and choose what is worth learning from,
# - clone your driving, and say how well that worked,
# - say where a clone fails, and why,
# - let two networks race in one world, and judge who won.
#
# *About 60 minutes. Before: lesson 09.*
#
# **Recap.** A policy gets a percept and gives an action. In lesson 09 a network found its policy by trying
# things out, from rewards alone.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import bars, check, film, hint, progress, report, show, solution
from ai4u_edu.lessons.exercises.lesson_10 import (
    best_network,
    my_drives,
    one_drive,
    touched,
    track,
)
from ai4u_edu.training import clone, evaluate

# %% [markdown]
# ## Show it
#
# Run the cell, and drive to the box with **W A S D**, five times or more. After each drive the next one
# begins, somewhere else. Drive as you want the robot to drive: turn until you face the box, then go. Each
# episode is kept as a file in the folder `drives`.

# %%
show("box_chase", record="drives")

# %% [markdown]
# `my_drives()` ends the world and gives your last five drives that reached the box. (If you drove fewer
# than five times, a scripted player fills in the rest.)

# %%
for episode in my_drives():
    print(episode)

# %% [markdown]
# Such a file holds what you *did*, decision by decision, and the seed. It need not hold what the robot
# *sensed*: the same seed and the same actions give the same world again, to the last digit.
#
# ## What is worth learning from?
#
# A drive in which the robot fell teaches falling. An episode knows a few things about itself:
# `episode.success` (was the goal reached?), `episode.seconds`, `episode.seed`, and
# `len(episode.agent())`, the number of its decisions.
#
# ### Exercise 10.1: good enough to learn from
#
# Return a list of the episodes that a clone should learn from, and no others. (A *list comprehension*
# makes a list from another one: `[x for x in numbers if x > 3]` holds the numbers above 3.)


# %% tags=["exercise-10.1"]
def good(episodes):
    return episodes


# %%
check("10.1", good)

# %% [markdown]
# ## The clone
#
# The drives give a long list of pairs: *this is what it sensed* and *this is what you did*. A network is
# now changed a little, 2000 times over, so that it answers each percept more like you did. That is called
# **behaviour cloning**, and it is **supervised learning**: for each question there is a right answer. No
# reward is needed, and no trial and error.
#
# ### Exercise 10.2: show it
#
# The clone below has seen one drive of a scripted player. What do you think: in how many of 100 worlds will
# it reach the box? Check it; then give it what it needs to reach the box in at least 50 of 100.

# %% tags=["exercise-10.2"]
my_clone = clone(one_drive(), "clone.onnx", quiet=True)

# %%
check("10.2", my_clone)

# %% [markdown]
# Let it drive. Do you see your own habits?

# %%
film("box_chase", trained_brain("clone.onnx"), seed=5, limit=100)

# %% [markdown]
# ## Where it fails
#
# A clone knows what you did **where you were**. Where you never were, it can only guess. Let your clone
# begin in places where nobody has ever begun: right at the edge. The clone of our scripted player falls from
# most of them, although nothing but the place is new. From how many of them does yours reach the box?

# %%
scene = Scene.load("box_chase").build()
scene.agents[0].use_brain(trained_brain("clone.onnx"))
for place in [(4.3, 0, 1.57), (0, -4.3, 1.57), (2, 4.3, -1.57), (4.3, 2, -1.57)]:
    scene.reset(seed=1)
    scene.agents[0].body.move_to(place[0], place[1], heading=place[2])
    while not scene.agents[0].done and scene.agents[0].steps < 200:
        scene.step()
    robot = scene.agents[0]
    how = "reached the box" if touched(robot) else "fell" if robot.done else "is still on its way"
    print(f"from {place}: {how} after {robot.steps} decisions")

# %% [markdown]
# It gets worse. A small mistake leads to a place where you never were; there it makes a larger one, and
# so on. Clones of people who drive perfectly suffer most from that: they were never shown how to get out
# of trouble. (So it can help if one of your drives has a mistake in it that you correct.)
#
# ## A race
#
# `track(blue, purple)` makes a world for two, with the box in the middle and both equally far away from it.
# Each of them can be a network's file or a function.
#
# ### Exercise 10.3: the referee
#
# Write who wins. `sim.step()` goes on by one decision. The race is over when one of the two is done
# (`blue.done`): if it touched the box, it won; if it fell, the other one won. Return `"blue"`, `"purple"`,
# or `None` if nobody is done after 300 steps. `touched(blue)` says whether the blue robot is at the box.


# %% tags=["exercise-10.3"]
def race(sim, seed):
    blue, purple = sim.agents
    return "blue"


# %%
check("10.3", race)

# %% [markdown]
# Your clone is blue. Purple is the network of lesson 09 that learned by trying (if you have not kept
# one, the one that comes with the package). Who will win? Write down a guess for ten races.

# %%
results = [race(track("clone.onnx", best_network()), seed) for seed in range(10)]
bars(
    {"your clone": results.count("blue"), "learned by reward": results.count("purple")},
    ylabel="races won",
    title="ten races",
)

# %%
film(track("clone.onnx", best_network()), seed=4, limit=200)

# %% [markdown]
# A clone is rarely better than its teacher: all it does is copy. The one that learned by reward goes for
# the reward, and drives in ways that you would never have shown it. But it needed thousands of tries,
# falls and all; the clone needed five drives and no fall. Which would you rather have: in a game, in a
# car, in an operating theatre?

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Let somebody else drive, and clone them. Can your class tell from a film whose clone it is?
# - How many drives does it take? Draw success against 1, 2, 3, 5, 8 drives: `evaluate(my_clone,
#   "box_chase", episodes=50)`.
# - Drive badly on purpose, always turning left, and race that clone. What did it learn?
#
# **Words of this lesson:** demonstration, behaviour cloning, supervised learning, clone. **Next:** 11, in
# which you look into such a network.
