# %% [markdown]
# # 11 Learn from yourself: five drives are enough
#
# ![Two robots race to a box that stands between them](pictures/11.png)
#
# A baby does not find out by chance how to use a spoon. It watches. In this lesson you show a robot how
# you drive, five times, and a network learns to do the same. Then it races against a network that was
# shown nothing.
#
# **When you have finished, you can**
#
# - record what you drive, and choose what is worth learning from,
# - clone your driving, and say how well that worked,
# - say where a clone fails, and why: which of its readings made it do that,
# - let two networks race in one world, and judge who won.
#
# *About 95 minutes. Before: lesson 10. Exercises 11.1 and 11.2 can be solved with code, or with boxes to
# tick.*
#
# **Recap.** A policy gets a percept and gives an action. In lesson 10 a network found its policy by
# trying things out, from rewards alone.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu import explain
from ai4u_edu.learn.training import clone, evaluate
from ai4u_edu.lessons import (
    bars,
    cards,
    check,
    compare,
    film,
    hint,
    predict,
    progress,
    report,
    show,
    solution,
)
from ai4u_edu.lessons.exercises.lesson_11 import (
    best_network,
    lamp_drives,
    lamp_successes,
    lamp_world,
    looked_at,
    my_drives,
    one_drive,
    touched,
    track,
)
from ai4u_edu.lessons.exercises.lesson_11_choice import (
    clone_of,
    conditions,
    last_drives,
    show_choice,
    show_clone,
    worlds_reached,
)

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
drives = my_drives()
for episode in drives:
    print(episode)

# %% [markdown]
# Such a file holds what you *did*, decision by decision, and the seed. It need not hold what the robot
# *sensed*: the same seed and the same actions give the same world again, to the last digit.
#
# ## A list from a list
#
# Often you want a list that is made from another list: some of its members, or something computed from
# each of them. With a loop that takes four lines:

# %%
numbers = [3, 8, 1, 9]
large = []
for n in numbers:
    if n > 3:
        large.append(n)
print(large)

# %% [markdown]
# Python has a short form, the **list comprehension**. It stands in square brackets, and reads like a
# sentence: "n, for each n in numbers, if n is above 3".

# %%
print([n for n in numbers if n > 3])
print([2 * n for n in numbers])
print([n * n for n in numbers if n < 5])

# %% [markdown]
# It has three parts:
#
# 1. what goes into the new list: `n`, or `2 * n`,
# 2. where it comes from: `for n in numbers`,
# 3. which of them, if not all: `if n > 3`.
#
# The name (`n`) is yours to choose. It works with all lists, also with a list of drives:

# %%
print([episode.seconds for episode in drives])

# %% [markdown]
# ## What is worth learning from?
#
# A drive in which the robot fell teaches falling. An episode knows a few things about itself:
# `episode.success` (was the goal reached?), `episode.seconds`, `episode.seed`, and
# `len(episode.agent())`, the number of its decisions.
#
# ### Exercise 11.1: good enough to learn from
#
# Return a list of the episodes that a clone should learn from, and no others.


# %% tags=["exercise-11.1"]
def good(episodes):
    return episodes


# %%
check("11.1", good)

# %% [markdown]
# Without code: tick the conditions that a drive has to meet, and set their numbers. `reached` is 1 for
# drives that reached the box, and 0 for all others. *Try* shows what your conditions choose from six
# drives.

# %%
cards(
    "11.1", conditions, preview=show_choice, reached=(0, 1), min_seconds=(0, 8), max_seconds=(0, 8)
)

# %% [markdown]
# ## The clone
#
# The drives give a long list of pairs: *this is what it sensed* and *this is what you did*. A network is
# now changed a little, 2000 times over, so that it answers each percept more like you did. That is called
# **behaviour cloning**, and it is **supervised learning**: for each question there is a right answer. No
# reward is needed, and no trial and error.
#
# ### Exercise 11.2: show it
#
# The clone below has seen one drive of a scripted player. In how many of 100 worlds will it reach the
# box?

# %%
predict("11.clone", ...)

# %% [markdown]
# Train it, and check it. Then give it what it needs to reach the box in at least 20 of 40 other worlds.

# %% tags=["exercise-11.2"]
my_clone = clone(one_drive(), "clone.onnx", quiet=True)

# %%
check("11.2", my_clone)

# %%
compare("11.clone", worlds_reached("clone.onnx", worlds=100))

# %% [markdown]
# Without code: here are your last drives, whatever became of them (a scripted player fills in the rest).
# Tick those that the clone should learn from; the number says how many times it is shown that drive.
# *Try* trains it, and lets it drive.

# %%
for number, episode in enumerate(last_drives(), 1):
    print(f"drive_{number}:", "reached the box" if episode.success else "did not reach the box")
    film(episode)
cards("11.2", clone_of, preview=show_clone, **{f"drive_{n}": (1, 3) for n in range(1, 7)})

# %% [markdown]
# Let your clone drive. Do you see your own habits?

# %%
film("box_chase", trained_brain("clone.onnx"), seed=5, limit=100)

# %% [markdown]
# ## Where it fails
#
# A clone knows what you did **where you were**. Where you never were, it can only guess. Let your clone
# begin in four places where nobody has ever begun: right at the edge. The clone of our scripted player
# falls from most of them, although nothing but the place is new. From how many of the four will yours
# reach the box?

# %%
predict("11.edge", ...)

# %%
scene = Scene.load("box_chase").build()
scene.agents[0].use_brain(trained_brain("clone.onnx"))
reached = 0
for place in [(4.3, 0, 1.57), (0, -4.3, 1.57), (2, 4.3, -1.57), (4.3, 2, -1.57)]:
    scene.reset(seed=1)
    scene.agents[0].body.move_to(place[0], place[1], heading=place[2])
    while not scene.agents[0].done and scene.agents[0].steps < 200:
        scene.step()
    robot = scene.agents[0]
    how = "reached the box" if touched(robot) else "fell" if robot.done else "is still on its way"
    print(f"from {place}: {how} after {robot.steps} decisions")
    reached += touched(robot)
compare("11.edge", reached)

# %% [markdown]
# It gets worse. A small mistake leads to a place where you never were; there it makes a larger one, and
# so on. Clones of people who drive perfectly suffer most from that: they were never shown how to get out
# of trouble. (So it can help if one of your drives has a mistake in it that you correct.)
#
# ## A race
#
# `track(blue, purple)` makes a world for two, with the box in the middle and both equally far away from
# it. Each of them can be a network's file or a function.
#
# ### Exercise 11.3: the referee
#
# Say who wins. `sim.step()` runs one decision. The race is over when one of the two is done
# (`blue.done`): if it touched the box, it won; if it fell, the other one won. Return `"blue"`,
# `"purple"`, or `None` if nobody is done after 300 steps. `touched(blue)` says whether the blue robot is
# at the box.


# %% tags=["exercise-11.3"]
def race(sim, seed):
    blue, purple = sim.agents
    return "blue"


# %%
check("11.3", race)

# %% [markdown]
# Your clone is blue. Purple is the network of lesson 10 that learned by trying (if you have not kept one,
# the one that comes with the package). How many of ten races will your clone win?

# %%
predict("11.race", ...)

# %%
results = [race(track("clone.onnx", best_network()), seed) for seed in range(10)]
bars(
    {"your clone": results.count("blue"), "learned by reward": results.count("purple")},
    ylabel="races won",
    title="ten races",
)
compare("11.race", results.count("blue"))

# %%
film(track("clone.onnx", best_network()), seed=4, limit=200)

# %% [markdown]
# A clone is rarely better than its teacher: all it does is copy. The one that learned by reward goes for
# the reward, and drives in ways that you would never have shown it. But it needed thousands of tries,
# falls and all; the clone needed five drives and no fall. Which would you rather have: in a game, in a
# car, in an operating theatre?

# %% [markdown]
# ## Why did it do that?
#
# Here is another world: in it a lamp stands behind the box, always. The robot senses both, the lamp a bit
# better. Somebody drove to the box 60 times and never looked at the lamp. A clone learns from that, and it
# drives well:

# %%
clone(lamp_drives("behind"), "lamp.onnx", quiet=True)
print("the lamp behind the box:", lamp_successes("lamp.onnx", "behind"), "of 20")

# %% [markdown]
# Now the lamp is put somewhere else; the box stays. In how many of 20 worlds will the clone reach it?

# %%
predict("11.lamp", ...)

# %%
compare("11.lamp", lamp_successes("lamp.onnx", "elsewhere"))
film(lamp_world("elsewhere"), trained_brain("lamp.onnx"), seed=101, limit=40)

# %% [markdown]
# It fails. But *why*? Ask it. Take away one reading (put its mean in its place), and see how far
# the action moves: that is called **occlusion**. A reading that the clone does not need moves nothing.

# %%
bars(
    looked_at("lamp.onnx", lamp_drives("behind", 4)[3]),
    ylabel="moves the action by",
    title="without the box, without the lamp",
)

# %% [markdown]
# Nobody told it to look at the lamp. But in all that it was shown, to go to the lamp was as good as to go
# to the box, and easier to see. Such a hint, which only happens to be there, is a **spurious cue**. In the
# page, "Because of what" in the tab Drive shows the same for each decision.
#
# Be careful with it. Two readings that say the same can both seem unimportant: without one, the other one
# still tells.
#
# ### Exercise 11.4: what does it not look at?
#
# `policy` is a function from percept to action. Return the list of the names of all readings that it does
# not look at: without them, its action stays the same.
# `explain.occlusion(policy, percept, baseline=baseline, groups="sensor")` has `names`, and in the same
# order `importance`: how far the action moved without each.


# %% tags=["exercise-11.4"]
def blind(policy, percept, baseline):
    return []


# %%
check("11.4", blind)

# %% [markdown]
# Now you know what to fix. It was never shown a drive in which the lamp and the box are apart. So show it 60
# others: the lamp stands somewhere else in each.

# %%
clone(lamp_drives("anywhere"), "fixed.onnx", quiet=True)
print("the lamp elsewhere:", lamp_successes("fixed.onnx", "elsewhere"), "of 20")
bars(
    looked_at("fixed.onnx", lamp_drives("behind", 4)[3]),
    ylabel="moves the action by",
    title="the fixed clone",
)

# %% [markdown]
# Now it is the box that counts, and the lamp moves the action hardly at all. Did it become better? Compare
# the three numbers of worlds. The first clone, with its lamp in place, reaches the box more often than the
# fixed one: the lamp was an easy hint, and the reading of the box is noisy. But it fails everywhere else.
# A network that does well in worlds like those that it learned from may have learned something else than
# you meant.
#
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** You always drive around the box on the left. What will your clone do?
#
# - a: Find the shortest way by itself.
# - b: Nothing, because there is no reward.
# - c: Drive around the box on the left.
#
# **2.** What does learning by reward need that cloning does not?
#
# - a: A world in which it may try, and fail, thousands of times.
# - b: Somebody who shows it what to do.
# - c: A right answer for each percept.
#
# **3.** Your clone falls when it begins near the edge. What is the best thing to do?
#
# - a: Train it longer with the same drives.
# - b: Show it drives that begin near the edge.
# - c: Add the drives in which you fell.

# %% tags=["exercise-11.exit"]
answers = ["", "", ""]

# %%
check("11.exit", answers)

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
# **Words of this lesson:** demonstration, list comprehension, behaviour cloning, supervised learning,
# clone, occlusion, spurious cue. **Next:** 12, in which you look into such a network.
