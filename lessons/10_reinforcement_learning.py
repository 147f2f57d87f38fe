# %% [markdown]
# # 10 Reinforcement learning: nobody tells it how
#
# ![A robot's way to the box, driven by a network that learned it](pictures/10.png)
#
# So far you have written the brains. Now you write none. You put a robot on a plate, say what pays, and
# wait. It tries this and that, falls off, and tries again. Some minutes later it drives to the box as if
# it had always known how.
#
# **When you have finished, you can**
#
# - say what a policy, a value and a discount are,
# - step a Gymnasium environment by hand, and read its spaces,
# - write the one line by which a learner learns from a step,
# - train a network with SAC, and read its learning curve,
# - find out how good it is, on worlds that it never saw,
# - predict what a learner makes of a wrong reward.
#
# *About 105 minutes, some of them waiting. Before: lesson 09. You know Q-learning already? Skim this
# lesson, and go on with the one that is called "Inside learning".*
#
# **Recap.** A reward is paid after each decision. An agent that learns does more of what paid, whether or
# not you meant it.

# %% tags=["setup"]
import gymnasium

from ai4u_edu import *
from ai4u_edu.learn.training import evaluate, still
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
    solution,
)
from ai4u_edu.lessons.exercises.lesson_10 import corridor, keep, learn, learn_house
from ai4u_edu.lessons.wrong_reward import learn_wrong_reward

# %% [markdown]
# ## A beginner
#
# The part that decides is called the **policy**: it maps a percept to an action. Everything that you
# wrote in lesson 06 was a policy. A beginner's policy is chance. `evaluate` lets a policy drive in many
# worlds, and counts.
#
# In the box chase an episode ends when the robot touches the box or falls, or after 3000 decisions. In
# how many of 20 worlds will pure chance reach the box?

# %%
predict("10.chance", ...)  # your guess, in place of the three dots

# %%
beginner = evaluate("random", "box_chase", episodes=20, quiet=True)
print(beginner)
compare("10.chance", beginner.successes)

# %% [markdown]
# So chance does find the box now and then. All learning by reward starts there: you can't learn from
# something that never happens.
#
# ## A world as an environment
#
# Some people write worlds, others write programs that learn. They agreed on how the two talk to each
# other, so that every learner fits every world. The agreement is called **Gymnasium**, and a world that
# follows it is an **environment**. It has two functions, `reset` and `step`:

# %%
env = gymnasium.make("ai4u_edu/BoxChase-v0")
observation, info = env.reset(seed=1)
print("the box:", observation["orientation"].round(2))
for _ in range(3):
    observation, reward, terminated, truncated, info = env.step([0, -1, 0, 0])  # turn left
    print("the box:", observation["orientation"].round(2), "  reward:", reward)

# %% [markdown]
# One `step` is one decision. It gives back five things: the `observation` (Gymnasium's word for a
# percept), the `reward`, `terminated` (the episode has ended: by a touch, say, or a fall), `truncated`
# (it was cut off, because time is up), and an `info` for people, which no learner looks at.
#
# What goes in and what comes out? The environment's **spaces** say so. This robot takes four numbers with
# decimals, each from a range: it has **continuous actions**. Other robots can only choose one of a few
# moves: they have **discrete actions**. In the grid world there are five of them, from 0 (stay) to 4:

# %%
print("box chase: ", env.action_space)
grid_world = gymnasium.make("ai4u_edu/GridWorld-v0", scene=still(Scene.load("grid_world")))
print("grid world:", grid_world.action_space)

# %% [markdown]
# What pays in the box chase? Touching the box pays 100, falling costs 1, and both end the episode. Each
# decision that brings the robot closer than ever before pays 0.01; any other decision costs 0.001. (The
# first decision pays 0: there is no distance before it to compare with.)
#
# ## Now or later
#
# Would you rather get 100 coins now, or 100 coins next year? A learner thinks like you. A reward that
# comes one decision later counts a bit less: it is multiplied by the **discount**, 0.98 for example. A
# reward two decisions later is multiplied by 0.98 · 0.98, and so on. The sum of all rewards of an
# episode, each counted like this, is the **discounted return**. That is why a quick robot earns more than
# a slow one.
#
# ### Exercise 10.1: what later is worth now
#
# `rewards` is a list: the first reward is paid now, the next one a decision later. Return what they are
# worth now, added up. For `[0, 0, 100]` and a discount of 0.5 that is 0 + 0 + 100 · 0.25 = 25.


# %% tags=["exercise-10.1"]
def worth(rewards, discount):
    return sum(rewards)


# %%
check("10.1", worth)

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
# After each step it knows more. The step brought a `reward`, and now it stands in another cell.
# `best_next` is the most that it expects from there, as far as it knows. So the step was worth
#
# ```python
# target = reward + discount * best_next
# ```
#
# Its old `value` was different. But one step proves little: it may have slipped. So it moves the value
# only part of the way to the target; the **learning rate** says how far.
#
# ### Exercise 10.2: one step of learning
#
# Return the new value. (If `rate` is 0.5, it lies in the middle between the old value and the target.)


# %% tags=["exercise-10.2"]
def update(value, reward, best_next, rate, discount):
    return value


# %%
check("10.2", update)

# %% [markdown]
# Watch what the walker knows after 1, 5, 10 and 40 walks. Which cell (0 to 7) will be the first one to
# have a value above 0? And how does the next one find out?

# %%
predict("10.cell", ...)

# %%
history = corridor(update)
plot(
    {f"after {walks} walks": history[walks - 1] for walks in (1, 5, 10, 40)},
    x=range(8),
    xlabel="cell (0: the pit, 7: the goal)",
    ylabel="value of the better step",
)
learned = [values for values in history if max(values) > 0]
if learned:  # once exercise 10.2 is solved
    compare("10.cell", learned[0].index(max(learned[0])))

# %% [markdown]
# The value creeps from the goal back to the start, one cell after the other. This is called
# **Q-learning**, and everything that follows is built on it. The table of values is a **Q-table**.
#
# A table can clean a house, too. In the grid world a robot has to visit three dirty places (+1 each, and
# +10 for the last one); running into an enemy costs 10. A row of its table is a cell *and* which places
# are still dirty. The five discrete actions are the columns. `learn_house` calls `q_learning(grid_world)`
# from `ai4u_edu.learn.training`, which uses the line that you wrote. It takes about 20 seconds.

# %%
table = learn_house(grid_world)
print("rows:", len(table.values))
groups = range(0, len(table.returns), 20)
plot(
    {"return": [sum(table.returns[n : n + 20]) / len(table.returns[n : n + 20]) for n in groups]},
    x=groups,
    xlabel="episodes learned from",
    ylabel="return, mean of 20",
)

# %%
film(still(Scene.load("grid_world")), table.drive, limit=100)

# %% [markdown]
# That is a good table for **this** house: `still` keeps everything in the same place. With dirt and
# enemies somewhere else in each episode, most rows would never be seen twice.
#
# ## From a table to a network
#
# A table has a row for each cell. The robot of the box chase has 120 numbers from its rays alone, each
# with decimals: there are more percepts than a table could ever have rows. So a **neural network** takes
# the table's place. It gets a percept and *guesses* the value; a percept that looks similar gets a
# similar guess. A second network is the policy, and is taught to do what the first one values.
#
# One recipe for that is called **SAC**, soft actor-critic. The *critic* guesses values, the *actor*
# drives. *Soft* means that it is also paid a little for trying different things, so that it does not stop
# too early with the first thing that worked.
#
# You need not write SAC yourself. **Stable-Baselines3** is a library with the usual recipes: SAC, PPO,
# DQN and more. It takes any Gymnasium environment. Its four lines, for a training that is much too short:

# %%
from stable_baselines3 import SAC

flat = gymnasium.make(
    "ai4u_edu/BoxChase-v0", observation="flat"
)  # all readings in one row of numbers
model = SAC("MlpPolicy", flat, learning_starts=50, seed=0)
model.learn(100)
observation, info = flat.reset(seed=1)
action, _ = model.predict(observation)
print("for these", len(observation), "numbers it does:", action.round(2))

# %% [markdown]
# For the real training we use `learn(steps, seed)`. It is one line: `train("box_chase", "sac", steps=...,
# seed=...)` from `ai4u_edu.learn.training`, which calls Stable-Baselines3 and tests the network now and then.
# The robot decides six times a second in it, and a try ends after 100 decisions. Every 500 decisions it
# drives in 30 worlds, to find out how good it is; it stops by itself when it has won all of them three
# times in a row.
#
# ### Exercise 10.3: long enough
#
# 400 decisions are a minute of the robot's life. Is that enough? Run it, look at the curve below, and let
# the robot learn for as long as it takes to reach the box in at least 95 of 100 worlds that it never saw.
# (Training takes about half a minute on most machines.)

# %% tags=["exercise-10.3"]
trained = learn(steps=400, seed=0)

# %%
check("10.3", trained)

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
# lesson 11. Nobody told this robot which way is left.

# %%
keep(trained, "sac.onnx")
film("box_chase", trained_brain("sac.onnx"), seed=7, limit=100)

# %%
print(evaluate("sac.onnx", "box_chase", episodes=10, quiet=True))

# %% [markdown]
# Why worlds that it never saw? A student who has learned the answers to one test by heart gets full marks
# in that test. Another test shows whether she understands. A seed below 4 billion is never used in a
# training here, so all the seeds that you know are "another test".
#
# ## A learner and a wrong reward
#
# In lesson 09 you said which of six characters a reward asks for. Does a robot that learns find that out
# by itself? This one should touch a box. It is paid 10 for the touch, which ends the episode; and so that
# it finds the way, up to 3 at each of its 60 decisions for being near the box. A fall costs 1.
#
# ### Exercise 10.4: the wrong reward, learned
#
# First write down what you think it will do in most worlds once it has learned: `"touches"` (the box),
# `"lingers"` (on the plate until time is up, without a touch) or `"falls"`. Then run the cell: it trains
# for about 15 seconds.


# %% tags=["exercise-10.4"]
prediction = "?"
hacked = learn_wrong_reward()

# %%
check("10.4", prediction, hacked)

# %% [markdown]
# Nobody programmed that, and nobody wanted it. The robot did not misunderstand you: it did what pays.

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** Two robots touch the box, which pays 100 and ends the episode. One takes 20 decisions, the
# other 60. The discount is 0.98. Whose discounted return is larger?
#
# - a: The slower one's: it has had more decisions that pay.
# - b: The quicker one's.
# - c: They are the same: both get 100.
#
# **2.** A walker learns a corridor with a Q-table of zeros. On its first walk it reaches the goal. Which
# values have changed?
#
# - a: The values of all steps on its way.
# - b: None: it takes many walks to learn something.
# - c: The value of its last step only.
#
# **3.** A network won in all worlds that it was trained in. What do you know about worlds that it has
# never seen?
#
# - a: Nothing yet: it has to be tested there.
# - b: It will win nearly all of them.
# - c: It will lose most of them, since it knows the others by heart.

# %% tags=["exercise-10.exit"]
answers = ["", "", ""]

# %%
check("10.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Train with three other seeds, and draw the three curves into one plot. How much of learning is luck?
# - `train("box_chase", "ppo", out="runs/ppo")` is another recipe. It needs more decisions, but less
#   arithmetic for each. Which one becomes good sooner: in decisions? in seconds (`each.seconds`)?
# - Change the scene's rewards (lesson 09), and train. Did you get what you said?
# - Where is it good to be? The network's critic can tell, or rollouts from many places. Bright places are worth
#   more. What does the map look like when the robot faces away from the box?

# %%
from ai4u_edu import explain
from ai4u_edu.explain.plots import plot_value_map

plot_value_map(explain.value_map("zoo:box_chase", "box_chase", columns=8, heading="box"))

# %% [markdown]
# ### Exercise 10.5: what does it look at most?
#
# `told` says how far an action moves without each slot of the percept (lesson 11 says more): `told.names`
# are the slots, and `told.shift[n]` is a list of how far each number of the action moves without slot n,
# to one side or to the other. Return the name of the slot that moves any number the furthest.


# %% tags=["exercise-10.5"]
def looks_most_at(told):
    return told.names[0]


# %%
check("10.5", looks_most_at)

# %% [markdown]
# **Words of this lesson:** policy, Gymnasium, environment, continuous, discrete, discount, discounted
# return, value, learning rate, Q-learning, Q-table, neural network, SAC, Stable-Baselines3, learning
# curve. **Next:** 11, in which a network learns from you.
