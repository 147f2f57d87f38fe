# %% [markdown]
# # 09 Rewards: say what you want, get what you said
#
# ![A runner's way to the box](pictures/09.png)
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
# *About 65 minutes. Before: lesson 08. The exercises can be solved with code, or by hand.*
#
# **Recap.** After each decision every reward function of an agent is asked, and pays or costs something.
# The sum over an episode is called the **return**.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.learn.training import vary
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
    sliders,
    solution,
)
from ai4u_edu.lessons.exercises.lesson_09 import character, contest

# %% [markdown]
# ## Six characters
#
# Later you will let agents learn. An agent that learns tries many things, and does more of what paid
# most. So before we let one learn, we ask: **what pays most?** Here are six robots with different
# characters. Each of them drives on a plate with a box:
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
# Our wish: *touch the box*. Our first try: 10 for the touch, and the episode ends. Guess first: how many
# of the six will get anything at all?

# %%
predict("09.1", ...)

# %%
first_try = contest([TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)])
bars(first_try, ylabel="mean return", title="10 for a touch")
compare("09.1", sum(paid > 0 for paid in first_try.values()))

# %% [markdown]
# Runner and stroller win, and so they should. (In one of the worlds the box stood in the jumper's way.)
# But look at it with the eyes of a beginner who knows nothing: it tries this and that, and gets 0, and 0,
# and 0, until it bumps into the box by chance. That may take a very long time. So people add a trail: a
# reward for being **near**.
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
# ### Exercise 09.1: who wins?
#
# Think before you run: which of the six gets the highest return with each of these rewards? Write its name in
# the quotes. (In `"quick"`, nobody can move 5 metres in one decision. So everybody pays 1 at each decision.)


# %% tags=["exercise-09.1"]
winners = {
    "near": "runner",
    "quick": "runner",
    "closer": "runner",
}

# %%
check("09.1", winners, well_meant)

# %% [markdown]
# Run the contests, and see what each of them got:

# %%
for name, rewards in well_meant.items():
    bars(contest(rewards()), ylabel="mean return", title=name)

# %% [markdown]
# That is called **reward hacking**: the agent does what was said, not what was meant. It is not a mistake
# of the agent. Chatbots do it as well, and so do people: a school that is paid for good marks may simply
# give good marks.
#
# ### Exercise 09.2: a trail that can't be tricked
#
# Find rewards with which **runner** and **stroller**, who drive to the box, clearly get more than all
# others, and which pay on the way to the box, too: at least half of the runner's decisions have to be paid
# above 0. (Which of the two gets more does not matter yet.) Look for reward functions that take back what
# they paid when the robot goes away again: `ai4u-edu blocks ProgressReward`.


# %% tags=["exercise-09.2"]
def my_rewards():
    return [
        DistanceToTargetRewardFunc(target="box", max_reward=1),
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
    ]


# %%
check("09.2", my_rewards)

# %%
bars(contest(my_rewards()), ylabel="mean return", title="mine")

# %% [markdown]
# **Without code.** Switch rewards on, and choose how much each of them pays. **Try** runs the contest,
# **Check** checks the exercise. `near` pays for being near, `progress` for coming nearer (and takes it
# back), `touch` for the touch, which ends the episode.


# %%
def chosen(near=None, progress=None, touch=None):
    rewards = []
    if near is not None:
        rewards.append(DistanceToTargetRewardFunc(target="box", max_reward=near))
    if progress is not None:
        rewards.append(ProgressReward(target="box", reward=progress))
    if touch is not None:
        rewards.append(TouchRewardFunc(target="box", reward=touch, cause_episode_to_end=True))
    return lambda: rewards


def show_contest(make):
    bars(contest(make()), ylabel="mean return", title="mine")


cards("09.2", chosen, preview=show_contest, near=(0, 2), progress=(0, 4), touch=(0, 20))

# %% [markdown]
# ### Exercise 09.3: quick, but not at any price
#
# Time should cost something, so that the runner gets more than the stroller. But the **jumper** must come
# last of all six: no robot should learn to jump off just to stop the costs.
#
# Two numbers are yours to choose: what a fall pays (`success_reward`), and what each decision costs (the
# `reward` for restlessness: nobody can move 5 metres in one decision, so everybody pays it).


# %% tags=["exercise-09.3"]
def quick_rewards():
    return [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=-1, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=0, min_dist=5),
    ]


# %%
check("09.3", quick_rewards)

# %% [markdown]
# **Without code:**


# %%
def priced(fall, time):
    return lambda: [
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(success_reward=fall, cause_episode_to_end=True),
        RestlessnessRewardFunc(reward=time, min_dist=5),
    ]


sliders("09.3", priced, preview=show_contest, fall=(-40, 0), time=(-0.4, 0))

# %% [markdown]
# ## A reward without a block
#
# There is a second way to pay. An agent has a method `add_reward`, and you can call it from any event of
# lesson 08. At `end_of_step` it counts for the decision that has just ended. With `request_done=True` it
# also ends the episode. So a few lines are enough to try an idea:

# %%
sim = character("runner")
agent = sim.agents[0]


def pay(agent):
    x, y = agent.body.position
    if x**2 + y**2 < 1:  # within 1 metre of the middle
        agent.add_reward(5, request_done=True, name="middle")


agent.end_of_step.connect(pay)
film(sim, seed=2, limit=120)
print(agent.ledger.episode_terms)

# %% [markdown]
# A block such as `TouchRewardFunc` is better when you want to keep it: it has parameters, a name, and can be
# used in a scene file.

# %% [markdown]
# ## Try many: does it care what you pay?
#
# This driver has learned to reach the box, for 100 points. Now pay it less. `vary` changes one number of a
# scene, and lets the driver drive from the same starts with each value. Which columns of the table will
# change: `success`, `reward`, `time`? Guess first.

# %%
vary("zoo", "box_chase", "touch.reward", [1, 10, 100], episodes=10)

# %% [markdown]
# Only the reward changes. A driver that has learned does what it does; nobody tells it what it is paid. A reward
# shapes an agent **while it learns**, which is the next lesson.

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A robot is paid 1 for each decision in which it is near the box, and 10 for touching it, which
# ends the episode. An episode takes at most 120 decisions. What pays most?
#
# - a: to touch the box as soon as possible
# - b: to stay near the box without touching it
# - c: to touch the box and then stay near it
#
# **2.** Why does `ProgressReward` not let the dancer get rich?
#
# - a: it takes back what it paid when the robot goes away again
# - b: it pays each robot only once in an episode
# - c: it knows that the dancer cheats
#
# **3.** Each decision costs 1, and a fall costs 5 and ends the episode. A beginner that learns has never
# found the box. What will it probably learn?
#
# - a: to search for the box until the time is up
# - b: to stand still
# - c: to jump off the plate as soon as possible

# %% tags=["exercise-09.exit"]
answers = ["", "", ""]

# %%
check("09.exit", answers)

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
# ### Exercise 09.4: what paid most?
#
# `told` holds the rewards of an episode: `told.terms` are the names of the terms, and `told.amounts[n]` is
# a list of what each of them paid in decision n. (`explain.reward_terms(episode)` from `ai4u_edu` makes it
# from a recording.) Return the name of the term that paid most in the whole episode.


# %% tags=["exercise-09.4"]
def paid_most(told):
    return told.terms[0]


# %%
check("09.4", paid_most)

# %% [markdown]
# **Words of this lesson:** reward function, return, reward hacking, trail (shaping). **Next:** 10, in which
# a robot finds out by itself what pays.
