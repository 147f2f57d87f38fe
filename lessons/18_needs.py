# %% [markdown]
# # 18 Needs: a creature that gets hungry
#
# ![The way of a creature between food and water](pictures/18.png)
#
# Nobody gives you points for drinking. You drink because you are thirsty. Could a robot want something by
# itself?
#
# **When you have finished, you can**
#
# - say what a need is: a level, a zone in which you feel well, and a drift,
# - compute how long a creature lives without food,
# - write a controller that weighs two needs,
# - say how a reward can come from inside.
#
# *About 55 minutes without the gold exercise. Before: lessons 06 and 09.*
#
# **Recap.** Rules have priorities. A reward says what is good, and you get what you said.

# %% tags=["setup"]
import math

from ai4u_edu import *
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
from ai4u_edu.lessons.exercises.lesson_18 import creature

# %% [markdown]
# ## Levels
#
# Our creature has two inner levels, **energy** and **water**, each from 0 to 100. Both fall on their own:
# that is their *drift*. Food adds 40 to the energy, water adds 40 to the water. If a level reaches 0, the
# creature dies.
#
# Between 40 and 80 the creature feels well: its **comfort zone**. Too much is not good either.
#
# `creature(controller)` makes its world. Run it, and drive: the panel shows the levels as bars, with the
# comfort zone marked. How long can you keep it well?

# %%
show(creature(WASDRBMoveController()), seed=1)

# %% [markdown]
# Keeping inner levels in balance is called **homeostasis**. Your body does it all day: with warmth,
# water, sugar, sleep.
#
# ### Exercise 18.1: how long?
#
# A creature has `level` of something, and loses `loss` of it each second. How many seconds does it take
# until it **leaves the comfort zone** at 40? If it is below 40 already: 0.


# %% tags=["exercise-18.1"]
def seconds_of_comfort(level, loss):
    return level


# %%
check("18.1", seconds_of_comfort)

# %% [markdown]
# ## What do I need most?
#
# The creature senses where food and water are (`to food`, `to water`: sine and cosine of the bearing, as
# in lesson 04), and its levels. Careful: in `inside`, energy and water go **from 0 to 1**. What the panel
# shows as 40 is 0.4 here.
#
# `to` steers towards a bearing. Food and water that were taken come back somewhere else three seconds
# later.


# %% tags=["setup"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% [markdown]
# ### Exercise 18.2: stay alive
#
# Keep the creature alive for a minute. In some of the worlds it begins with hardly any energy, or hardly
# any water: then it reaches what it lacks just in time, if it goes there first.


# %% tags=["exercise-18.2"]
def live(percept):
    energy, water = percept["inside"]
    return to(percept["to food"])


# %%
check("18.2", live)

# %%
film(creature(live), seed=1)

# %% [markdown]
# ## Too much
#
# Staying alive is not yet living well. Record the levels during a life:


# %%
def levels(controller, seed=1):
    sim = creature(controller)
    sim.reset(seed)
    agent = sim.agents[0]
    energy, water = [], []
    while not agent.done:
        energy.append(100 * agent.percept["inside"][0])
        water.append(100 * agent.percept["inside"][1])
        sim.step()
    return {"energy": energy, "water": water}


plot(levels(live), xlabel="decision (12 a second)", ylabel="level")

# %% [markdown]
# ### Exercise 18.3: live well
#
# Keep **both** levels between 40 and 80, for at least 60 of 100 decisions. When should the creature eat?
# When should it rather do nothing? (`{"move": [0, 0, 0, 0]}`)


# %% tags=["exercise-18.3"]
def live_well(percept):
    energy, water = percept["inside"]
    return {"move": [0, 0, 0, 0]}


# %%
check("18.3", live_well)

# %%
plot(levels(live_well), xlabel="decision (12 a second)", ylabel="level")

# %% [markdown]
# ### Exercise 18.4: gold: a dry summer
#
# *For fast finishers; optional.* In a dry summer both levels fall faster: energy by 4 a second,
# water by 6. Resting until a level is low, and then going, keeps the creature well in about 82 of 100
# decisions at best. Reach **83**, on average over 20 lives. What could it do while it rests?


# %% tags=["exercise-18.4"]
def dry_summer(percept):
    energy, water = percept["inside"]
    return {"move": [0, 0, 0, 0]}


# %%
check("18.4", dry_summer)

# %% [markdown]
# ## A reward from inside
#
# `HomeostaticReward` turns needs into a reward: less discomfort pays, more discomfort costs. Nobody says
# "eat". A creature that learns finds out by itself that eating feels good, and only while it is hungry.
#
# Which of your two controllers is paid more in a minute, `live` or `live_well`?

# %%
predict("18.paid", ...)

# %%
paid = {}
for name, controller in {"live": live, "live_well": live_well}.items():
    sim = creature(controller)
    sim.reset(1)
    while not sim.agents[0].done:
        sim.step()
    terms = sim.agents[0].ledger.episode_terms
    print(f"{name:10}", {term: round(value, 1) for term, value in terms.items()})
    paid[name] = sum(terms.values())
compare("18.paid", max(paid, key=paid.get))

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** A creature feels well between 0.4 and 0.8. Its energy is 0.75, its water 0.5. It eats (0.4 more
# energy). How does it feel?
#
# - a: Better: food is always good.
# - b: The same: it felt well before, so nothing changes.
# - c: Worse: now it has too much energy.
#
# **2.** A creature goes for food as soon as its energy is below 0.4. All the same its energy is often
# below the comfort zone. Why?
#
# - a: Its energy goes on falling while it drives there.
# - b: It should compare with 40, not with 0.4.
# - c: It eats too much at once.
#
# **3.** What does a `HomeostaticReward` pay for?
#
# - a: For touching food and water.
# - b: For feeling less discomfort than before.
# - c: For each second that it stays alive.

# %% tags=["exercise-18.exit"]
answers = ["", "", ""]

# %%
check("18.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Which needs does a phone have? A vacuum robot? A class? Give one of them levels, drifts and a comfort
#   zone.
# - `forage` is a scene of the library with rocks and two kinds of food. Play it, then write a controller
#   for it (it sees with rays: lesson 04).
# - Animals eat before they are hungry if food is rare. When is that clever? Change the time after which
#   food comes back, and try.
#
# **Words of this lesson:** need, level, drift, comfort zone, homeostasis, drive. **Next:** you build
# blocks of your own.
