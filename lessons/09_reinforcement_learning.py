# %% [markdown]
# # 09 Reinforcement learning: nobody tells it how
#
# ![A robot's way to the box, driven by a network that learned it](pictures/09.png)
#
# So far you wrote the brains. Now you write none. You put a robot on a plate, say what pays, and wait. It
# tries this and that, falls off, tries again. Some minutes later it drives to the box as if it had always
# known.
#
# **When you have finished, you can**
#
# - say what a policy, a value and a discount are,
# - write the one line by which a learner learns from a step,
# - train a network with SAC, and read its learning curve,
# - find out how good it is, on worlds that it never saw,
# - predict what a learner makes of a wrong reward.
#
# *About 85 minutes, some of them waiting. Before: lesson 07.*
#
# **Recap.** A reward is paid after each decision. An agent that learns does more of what paid, whether or
# not you meant it.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import check, film, hint, plot, progress, report, show, solution
from ai4u_edu.lessons.exercises.lesson_09 import corridor, keep, learn
from ai4u_edu.lessons.wrong_reward import learn_wrong_reward
from ai4u_edu.training import evaluate

# %% [markdown]
# ## A beginner
#
# The part that decides is called the **policy**: it maps a percept to an action. Everything that you
# wrote in lesson 05 was a policy. A beginner's policy is chance. `evaluate` lets a policy drive in many
# worlds, and counts.
#
# The robot in the box chase is out after 3000 decisions. Guess: in how many of 20 worlds does pure chance
# reach the box, and in how many does the robot fall?

# %%
beginner = evaluate("random", "box_chase", episodes=20, quiet=True)
print(beginner)

# %% [markdown]
# So chance does find the box now and then. All learning by reward starts there: what never happens can't
# be learned from.
#
# What pays in this world? 100 for touching the box, -1 for falling; both end the episode. Each decision
# that brings the robot closer than ever before pays 0.01, any other one costs 0.001.
#
# ## Now or later
#
# Would you rather get 100 coins now, or 100 coins next year? A learner thinks like you. It counts a
# reward that comes one decision later a bit less, by a factor that is called the **discount**; 0.98 is
# usual. Two decisions later counts 0.98 · 0.98, and so on. The sum of all rewards of an episode, each
# counted like this, is the **discounted return**. That is why a quick robot earns more than a slow one.
#
# ### Exercise 09.1: what later is worth now
#
# `rewards` is a list: the first reward is paid now, the next one a decision later. Return what they are
# worth now, all together. For `[0, 0, 100]` and a discount of 0.5 that is 0 + 0 + 100 · 0.25 = 25.


# %% tags=["exercise-09.1"]
def worth(rewards, discount):
    return sum(rewards)


# %%
check("09.1", worth)

# %% [markdown]
# How much less is 100 worth when it comes late? Change the discounts, and run it again:

# %%
steps = range(0, 101, 5)
plot(
    {f"discount {each}": [100 * each**n for n in steps] for each in (0.99, 0.98, 0.9)},
    x=steps,
    xlabel="decisions until the box is touched",
    ylabel="worth of 100 now",
)

# %% [markdown]
# ## Learning from one step
#
# Look at a smaller world first: a corridor with 8 cells. At its left end is a pit (-1), at its right end
# the goal (+1). A walker begins in cell 2 and steps left or right. It keeps a table: what is each step
# worth, in each cell? That is the step's **value**. At first all values are 0.
#
# After each step it knows more. The step brought a `reward`, and now it stands in another cell, from
# which, as far as it knows, `best_next` can be had. So the step was worth
#
# ```python
# target = reward + discount * best_next
# ```
#
# Its old `value` was something else. But once proves nothing: it may have slipped. So it moves the value
# only a part of the way to the target; the **learning rate** says which part.
#
# ### Exercise 09.2: one step of learning
#
# Return the new value. (If `rate` is 0.5, it lies in the middle between the old value and the target.)


# %% tags=["exercise-09.2"]
def update(value, reward, best_next, rate, discount):
    return value


# %%
check("09.2", update)

# %% [markdown]
# Watch what the walker knows after 1, 5, 10 and 40 walks. Before you run it: which cell will learn first
# that the goal is near, and how does the next one find out?

# %%
history = corridor(update)
plot(
    {f"after {walks} walks": history[walks - 1] for walks in (1, 5, 10, 40)},
    x=range(8),
    xlabel="cell (0: the pit, 7: the goal)",
    ylabel="value of the better step",
)

# %% [markdown]
# The value creeps from the goal back to the start, one cell after the other. This is called
# **Q-learning**, and everything that follows is built on it.
#
# ## From a table to a network
#
# A table has a row for each cell. Our robot has 120 numbers from its rays alone, each with decimals: there
# are more percepts than a table could ever have rows. So a **neural network** takes the table's place. It
# gets a percept and *guesses* the value; a percept that looks similar gets a similar guess. A second
# network is the policy, and is taught to do what the first one values.
#
# One recipe for that is called **SAC**, soft actor-critic. The *critic* guesses values, the *actor* drives.
# *Soft* means that it is also paid a little for trying different things, so that it does not stop too
# early with the first thing that worked.
#
# `learn(steps, seed)` trains with it, and is one line: `train("box_chase", "sac", steps=..., seed=...)`
# from `ai4u_edu.training`. The robot decides six times a second in it, and a try ends after 100
# decisions. Every 500 decisions it drives in 30 worlds, to find out how good it is; it stops by itself
# when it has won all of them three times in a row.
#
# ### Exercise 09.3: long enough
#
# 400 decisions are a minute of the robot's life. Is that enough? Run it, look at the curve below, and let
# the robot learn for as long as it takes to reach the box in at least 95 of 100 worlds that it never saw.
# (Training takes about half a minute on most machines.)

# %% tags=["exercise-09.3"]
trained = learn(steps=400, seed=0)

# %%
check("09.3", trained)

# %% [markdown]
# This is the **learning curve**. What did the robot learn first: to get closer, or to reach the box? Does
# it get better all the time, or is there a step back?

# %%
plot(
    {"success": [100 * each.success for each in trained.checks]},
    x=[each.steps for each in trained.checks],
    xlabel="decisions learned from",
    ylabel="worlds won, %",
    title="learning curve",
)

# %% [markdown]
# And this is what it looks like. `keep` writes the network to a file, `sac.onnx`; you will need it in
# lesson 10. Nobody told this robot which way is left.

# %%
keep(trained, "sac.onnx")
film("box_chase", trained_brain("sac.onnx"), seed=7, limit=100)

# %%
print(evaluate("sac.onnx", "box_chase", episodes=10, quiet=True))

# %% [markdown]
# Why worlds that it never saw? A pupil who learned the answers of one test by heart gets full marks in
# that test. Another test shows whether she understands. A seed below 4 billion is never used in a
# training here, so all the seeds that you know are "another test".
#
# ## A learner and a wrong reward
#
# In lesson 07 you said which of six characters a reward asks for. Does a robot that learns by itself find
# that out, too? This one should touch a box. It is paid 10 for the touch, which ends the episode; and so that
# it finds the way, up to 3 at each of its 60 decisions for being near the box. A fall costs 1.
#
# ### Exercise 09.4: the wrong reward, learned
#
# First write down what you think it will do in most worlds once it has learned: `"touches"` (the box),
# `"lingers"` (on the plate until time is up, without a touch) or `"falls"`. Then run the cell: it trains
# for about 15 seconds.


# %% tags=["exercise-09.4"]
prediction = "?"
hacked = learn_wrong_reward()

# %%
check("09.4", prediction, hacked)

# %% [markdown]
# Nobody programmed that, and nobody wanted it. The robot did not misunderstand you: it did what pays.

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Train with three other seeds, and draw the three curves into one plot. How much of learning is luck?
# - `train("box_chase", "ppo", out="runs/ppo")` is another recipe. It needs more decisions, but less
#   arithmetic for each. Which one gets good sooner: in decisions? in seconds (`each.seconds`)?
# - Change the scene's rewards (lesson 07), and train. Did you get what you said?
#
# **Words of this lesson:** policy, discount, discounted return, value, learning rate, Q-learning, neural
# network, SAC, learning curve. **Next:** 10, in which a network learns from you.
