# %% [markdown]
# # 14 Inside learning: for those who know reinforcement learning
#
# ![How often a walker stood in each cell of a corridor](pictures/14.png)
#
# You know what a policy, a return and Q-learning are. This lesson looks at what a library like
# Stable-Baselines3 hides from you: when to try something new, how a policy can be improved without a
# table of values, how much of a result is luck, and how worlds with several agents are stepped.
#
# **When you have finished, you can**
#
# - choose when a learner explores, and say what it costs,
# - write one step of policy gradient (REINFORCE) in ten lines,
# - say how many trainings it takes before you may call one method better,
# - step our scenes through the interfaces of Gymnasium and PettingZoo.
#
# *About 85 minutes. Before: "Reinforcement learning", or a course on it elsewhere. You need NumPy,
# classes and dictionaries. The last part needs* `pip install "ai4u-edu[multi]"`*.*
#
# **Recap.** A Q-table holds the value of each action in each state. An update moves a value a part of the
# way to `reward + discount * best_next`.

# %% tags=["setup"]
import math

import gymnasium
import numpy as np

from ai4u_edu import *
from ai4u_edu.learn.envs import parallel_env
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
from ai4u_edu.lessons.exercises.lesson_14_worlds import (
    BEST,
    explore,
    five_seeds,
    learn,
    score,
    softmax,
)

# %% [markdown]
# ## Exploration
#
# A corridor has 8 cells. A walker begins in cell 2. At the left end, two steps away, is a reward of
# **0.2**; at the right end, five steps away, a reward of **1**. The discount is 0.9, so the far reward is
# worth 0.66 at the beginning, and the near one 0.18. The walker learns by Q-learning, for 200 walks.
#
# `explore(epsilon, seed)` lets it live. `epsilon(walk, walks)` is the probability of a random step in
# this walk, instead of the step with the larger value. Here are two extremes:


# %%
def never(walk, walks):
    return 0


def always(walk, walks):
    return 1


# %% [markdown]
# How many of 20 walkers that never explore learn to go to the far reward? (Two equal values are decided
# by a coin, so the first walk is a random one.)

# %%
predict("14.never", ...)

# %%
lives = [explore(never, seed) for seed in range(20)]
compare("14.never", sum(bool(each.values[2, 1] > each.values[2, 0]) for each in lives))

# %% [markdown]
# Whoever finds the near reward first never looks any further. That is the dilemma of **exploration and
# exploitation**: try something new, or use what you know? This is where the two kinds of walkers spend
# their life:

# %%
for name, epsilon in {"never": never, "always": always}.items():
    visits = explore(epsilon, seed=1).visits
    bars({f"cell {cell}": count for cell, count in enumerate(visits)}, title=f"{name} explores")

# %% [markdown]
# ### Exercise 14.1: explore, then use it
#
# Return the probability of a random step in walk number `walk` (0, 1, 2, ...) of `walks`. At least 10 of
# 20 walkers have to find the far reward, and go straight to it in their last 20 walks: at least 90
# percent of the best return.


# %% tags=["exercise-14.1"]
def epsilon(walk, walks):
    return 0


# %%
check("14.1", epsilon)

# %% [markdown]
# What exploring costs, and what it brings:


# %%
def smooth(numbers, width=10):
    return [sum(numbers[n : n + width]) / width for n in range(0, len(numbers), width)]


plot(
    {
        name: smooth([100 * each / BEST for each in explore(one, seed=1).returns])
        for name, one in {"never": never, "always": always, "yours": epsilon}.items()
    },
    x=range(0, 200, 10),
    xlabel="walk",
    ylabel="return, % of the best",
)

# %% [markdown]
# `q_learning` in `ai4u_edu.learn.training` calls this probability `curiosity`; in Stable-Baselines3's DQN it is
# `exploration_initial_eps`, `exploration_final_eps` and `exploration_fraction`. SAC and PPO explore by
# drawing their actions from a distribution, and are paid a little for keeping it wide (*entropy*).
#
# ## Policy gradient
#
# A policy need not go through values at all. Let it be a table of **preferences**: two numbers in each
# cell, one for left and one for right. `softmax` makes probabilities of them:

# %%
for preferences in ([0, 0], [1, 0], [3, 0], [3, 3]):
    print(preferences, "->", softmax(preferences).round(2))

# %% [markdown]
# The walker draws its action from these probabilities. After an episode, the preferences are changed so
# that what was followed by large rewards gets more probable. This is **REINFORCE**, the oldest *policy
# gradient*. For each step of the episode:
#
# 1. Its **worth** is the discounted return from this step on: its own reward, plus `discount` times the
#    worth of the next step.
# 2. The **gradient** of the logarithm of the action's probability is, for a softmax, very simple: 1 minus
#    the probability for the action that was taken, and minus the probability for each other one.
# 3. All preferences of the step's cell move by `rate * worth * gradient`.
#
# An example: probabilities 0.8 and 0.2, the second action was taken. The gradient is [-0.8, 0.8]. With a
# worth of 2 and a rate of 0.1, the preferences move by [-0.16, 0.16].
#
# ### Exercise 14.2: policy gradient
#
# Return the new table of preferences. `preferences` is an array with a row for each cell, `episode` a
# list of `(cell, action, reward)`. `preferences.copy()` is a new table to write into.


# %% tags=["exercise-14.2"]
def reinforce(preferences, episode, rate, discount):
    after = preferences.copy()
    for cell, action, reward in reversed(episode):
        pass
    return after


# %%
check("14.2", reinforce)

# %% [markdown]
# Your lines learn the corridor. `learn` gives the return of each episode, in percent of the best, and the
# preferences at the end:

# %%
returns, preferences = learn(reinforce, rate=0.3, seed=0)
plot(
    {"return": smooth(returns)},
    x=range(0, 300, 10),
    xlabel="episode",
    ylabel="return, % of the best",
)
bars(
    {f"cell {cell}": softmax(preferences[cell])[1] for cell in range(1, 7)},
    ylabel="probability of a step to the right",
)

# %% [markdown]
# PPO, which trained most networks of our zoo, is this idea with a network in place of the table, a guess
# of the value that is subtracted from the worth (a *baseline*, which makes the steps less noisy), and a
# limit on how far the policy may move at once. You can read all of it:
# `ai4u_edu/learn/small/ppo.py` needs nothing but NumPy.
#
# ## How much of it is luck?
#
# Now the near reward is 0.5: harder to give up. The same training (with our lines), with five seeds:

# %%
plot(
    {f"seed {seed}": smooth(returns, 30) for seed, returns in enumerate(five_seeds())},
    x=range(0, 300, 30),
    xlabel="episode",
    ylabel="return, % of the best",
)

# %% [markdown]
# Nothing differs but the random numbers. Some runs find the far reward, others stay with the near one. So
# which learning rate is better, 0.3 or 1.0? `score(rate, seed)` trains, and gives the mean return of the
# last 50 episodes. Three people run five seeds each:

# %%
for seeds in (range(5), range(5, 10), range(10, 15)):
    means = [np.mean([score(rate, seed) for seed in seeds]) for rate in (0.3, 1.0)]
    print(f"seeds {seeds[0]} to {seeds[-1]}: 0.3 gets {means[0]:.0f}, 1.0 gets {means[1]:.0f}")

# %% [markdown]
# The first one reports that it does not matter, the second that 1.0 is better, the third that 0.3 is
# better. How far apart do two means have to be? The results of single runs scatter: their **standard
# deviation** is `np.std(results, ddof=1)`. The mean of n runs scatters less: by `deviation /
# math.sqrt(n)`, its **standard error**. The errors of two means add up like the sides of a right-angled
# triangle. A difference of less than twice that may well be luck.
#
# ### Exercise 14.3: may you claim it?
#
# `first` and `second` are lists with the results of two methods, one number for each seed. Return
# `"first"` or `"second"` if you may claim that this one is better, else `"unclear"`. If both are equally
# good, you should claim something in at most about one of ten comparisons; and a clear difference should
# not escape you.


# %% tags=["exercise-14.3"]
def claim(first, second):
    return "first" if np.mean(first) > np.mean(second) else "second"


# %%
check("14.3", claim)

# %% [markdown]
# Now ask it about learning rates, with 5, 20 and 60 runs each. (The last one takes some seconds.) What do
# you expect: from how many runs on is 0.5 better than 0.1, and 1.0 different from 0.3?

# %%
results = {rate: [score(rate, seed) for seed in range(60)] for rate in (0.1, 0.3, 0.5, 1.0)}
for runs in (5, 20, 60):
    said = [claim(results[a][:runs], results[b][:runs]) for a, b in ((0.1, 0.5), (0.3, 1.0))]
    print(f"{runs} runs: 0.1 against 0.5: {said[0]}; 0.3 against 1.0: {said[1]}")

# %% [markdown]
# A rule of thumb: to find a difference `d` between results that scatter by `s` in four of five cases, you
# need about `16 * (s / d) ** 2` runs of each. Half the difference takes four times the runs. Many
# published comparisons have five.
#
# ## Worlds for learners
#
# Any scene of this sandbox is a Gymnasium environment. `observation="flat"` gives one row of numbers,
# `"dict"` (the default) one array for each sensor. The loop that everybody writes:


# %%
def rollout(env, policy, seed):
    observation, info = env.reset(seed=seed)
    total, over = 0, False
    while not over:
        observation, reward, terminated, truncated, info = env.step(policy(observation))
        total, over = total + reward, terminated or truncated
    return total, info


env = gymnasium.make("ai4u_edu/LineFollow-v0", observation="flat")
print(env.unwrapped.describe())
env.action_space.seed(0)
total, info = rollout(env, lambda seen: env.action_space.sample(), seed=1)
print("by chance:", round(total, 2), "success:", info["success"])

# %% [markdown]
# `terminated` and `truncated` must not be mixed up in a learner: after a terminated episode nothing
# follows, so the value of what comes next is 0. A truncated one was only cut off, and its last state
# still has a value.
#
# With several agents that learn, Gymnasium is not enough. **PettingZoo** is the same idea for many: a
# step takes a dictionary of actions, one for each agent that still takes part, and gives back five
# dictionaries.

# %%
duel = parallel_env("sumo")
observations, infos = duel.reset(seed=1)
print("agents:", duel.agents)
actions = {name: duel.action_space(name).sample() for name in duel.agents}
observations, rewards, terminations, truncations, infos = duel.step(actions)
print("rewards:", rewards)
print("terminated:", terminations, "truncated:", truncations)

# %% [markdown]
# `env.agents` shrinks when agents are out, and is empty when the game is over. An agent's last reward
# comes with the step in which it goes out.
#
# ### Exercise 14.4: a game of several agents
#
# Play one game, and return a dictionary with the total reward of each agent. `policies[name]` is a
# function from an observation to an action. Begin with the seed.


# %% tags=["exercise-14.4"]
def play(env, policies, seed):
    totals = dict.fromkeys(env.possible_agents, 0)
    return totals


# %%
check("14.4", play)


# %% [markdown]
# A fight of a policy that attacks against chance:


# %%
def attack(seen):
    ahead, left = seen["opponent"][:2]
    angle = math.atan2(left, ahead)
    return np.array([abs(angle) < 0.5, np.clip(-2 * angle, -1, 1), 0, 0], np.float32)


space = duel.action_space("orange")
space.seed(0)
print(play(duel, {"blue": attack, "orange": lambda seen: space.sample()}, seed=1))

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** A walker never tries anything but what looks best. Near its start there is a small reward, far
# away a large one. What does it learn?
#
# - a: The way to the large reward, only more slowly.
# - b: Nothing: without exploration all values stay 0.
# - c: The way to the small reward.
#
# **2.** In an episode all rewards are 0. What does REINFORCE, without a baseline, learn from it?
#
# - a: To avoid the actions of this episode.
# - b: Nothing: the step is 0.
# - c: To repeat the actions of this episode.
#
# **3.** Method A won 80, 55 and 90 of 100 worlds with three seeds, method B 70, 85 and 60. What may you
# claim?
#
# - a: That it is unclear which one is better: run more seeds.
# - b: That A is better: its mean is larger.
# - c: That both are equally good.

# %% tags=["exercise-14.exit"]
answers = ["", "", ""]

# %%
check("14.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - A baseline: subtract the mean return of the last 20 episodes from the worth. Do fewer seeds get stuck?
#   Use your `claim` before you say so.
# - `train("box_chase", "sac", seed=...)` and `"ppo"` from `ai4u_edu.learn.training`, five seeds each: which one
#   needs fewer decisions, which one less time? How sure are you?
# - Let two REINFORCE learners play a repeated game against each other (rock, paper, scissors). Do they
#   settle?
#
# **Words of this lesson:** exploration, exploitation, epsilon, preference, softmax, policy gradient,
# REINFORCE, baseline, standard deviation, standard error, PettingZoo.
