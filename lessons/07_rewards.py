# %% [markdown]
# # 07 Rewards: say what you want, get what you said
#
# ![A runner's way to the box](pictures/07.png)
#
# A cleaning robot was paid for each crumb that it picked up. It found out that it could throw crumbs out
# again. Nobody had told it not to.
#
# **When you have finished, you can**
#
# - say what a reward function is, and when it pays,
# - guess which behaviour a reward really asks for,
# - fix a reward that can be tricked,
# - say why the reward is the most important line of a learning robot.
#
# *About 50 minutes. Before: lesson 06.*
#
# **Recap.** After each decision every reward function of an agent is asked, and pays or costs something.
# The sum over an episode is called the **return**.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import bars, check, film, hint, progress, report, show, solution
from ai4u_edu.lessons.exercises.lesson_07 import character, contest

# %% [markdown]
# ## Six characters
#
# Later you will let agents learn. An agent that learns tries many things, and does more of what paid
# most. So before we let one learn, we ask: **what pays most?** Here are six robots with different
# characters on a plate with a box:
#
# | name | what it does |
# |---|---|
# | runner | runs to the box and touches it |
# | stroller | the same, slowly |
# | lingerer | goes near the box, and stays there |
# | dancer | goes near the box, away from it, near, away ... |
# | sleeper | nothing |
# | jumper | drives straight on until it falls off the plate |
#
# Have a look at the dancer (or at another one):

# %%
film(character("dancer"), seed=3, limit=120)

# %% [markdown]
# ## A contest
#
# `contest(rewards)` runs all six with the same rewards, for ten seconds in each of several worlds, and
# returns the mean return of each. A learning agent would try to end up like the winner.
#
# Our wish: *touch the box*. Our first try: 10 for the touch, and the episode ends.

# %%
bars(
    contest([TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)]),
    ylabel="mean return",
    title="10 for a touch",
)

# %% [markdown]
# Runner and stroller win, and so they should. But look at it with the eyes of a beginner who knows
# nothing: it tries this and that, and gets 0, and 0, and 0, until it bumps into the box by chance. That
# may take a very long time. So people add a trail: a reward for being **near**.
#
# ## Three well-meant rewards

# %% tags=["setup"]


class Approach(RewardFunc):
    """Pays 1 for each decision that brought the agent closer to the box."""

    before = 0.0

    def on_reset(self, agent, view):
        self.before = view["box"].distance(view["robot"])

    def on_update(self, body, view):
        now = view["box"].distance(body)
        paid = 1.0 if now < self.before - 0.01 else 0.0
        self.before = now
        return paid


well_meant = {
    # near the box is good, at it is best
    "near": lambda: [
        DistanceToTargetRewardFunc(target="box", max_reward=1),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ],
    # be quick: each decision costs 1, until the episode is over; a fall ends it
    "quick": lambda: [
        TouchRewardFunc(target="box", reward=10),
        FallReward(success_reward=-1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=-1, min_dist=5),
    ],
    # each step towards the box is good
    "closer": lambda: [Approach()],
}

# %% [markdown]
# ### Exercise 07.1: who wins?
#
# Think before you run: which of the six gets the highest return with each of these rewards? Write down
# the name. (In `"quick"`, nobody can move 5 metres in one decision, so everybody pays for
# restlessness at each one.)


# %% tags=["exercise-07.1"]
winners = {
    "near": "runner",
    "quick": "runner",
    "closer": "runner",
}

# %%
check("07.1", winners, well_meant)

# %% [markdown]
# Run the contests, and see who got what:

# %%
for name, rewards in well_meant.items():
    bars(contest(rewards()), ylabel="mean return", title=name)

# %% [markdown]
# That is called **reward hacking**: the agent does what was said, not what was meant. It is not a bug in
# the agent. Chatbots do it as well, and people: a school that is paid for good marks may give good marks.
#
# ### Exercise 07.2: a trail that can't be tricked
#
# Find rewards with which the **runner** wins clearly, and which pay on the way to the box, too: at least
# half of the runner's decisions have to be paid above 0. Look for reward functions that take back what
# they paid when the robot goes away again: `ai4u-edu blocks ProgressReward`.


# %% tags=["exercise-07.2"]
def my_rewards():
    return [
        DistanceToTargetRewardFunc(target="box", max_reward=1),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %%
check("07.2", my_rewards)

# %%
bars(contest(my_rewards()), ylabel="mean return", title="mine")

# %% [markdown]
# ### Exercise 07.3: quick, but not at any price
#
# Time should cost something, so that the runner gets more than the stroller. But the **jumper** must come
# last of all six: no robot should learn to jump off just to stop the costs.
#
# Two numbers are yours to choose: what a fall pays (`success_reward`), and what each decision costs (the
# `reward` for restlessness: nobody can move 5 metres in one decision, so everybody pays it).


# %% tags=["exercise-07.3"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0, min_dist=5),
    ]


# %%
check("07.3", quick_rewards)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Invent a reward that lets the **sleeper** win. And one for the dancer.
# - Look up the rewards of a scene: `print(Scene.load("soccer").description.rewards)`. Can you think of a
#   way to trick them?
# - Where in life do people get what was said and not what was meant? Find three examples, and a better
#   "reward" for each.
#
# **Words of this lesson:** reward function, return, reward hacking, trail (shaping). **Next:** 08, in which
# your script drives a robot on another machine.
