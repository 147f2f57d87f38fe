# %% [markdown]
# # 21 Traces and signals: ink and messages
#
# ![A robot that followed a trail to its end](pictures/21.png)
#
# An ant can't tell another one where the food is. It leaves a trace on the ground, and the other one reads
# it. You can do both: write, and talk. Today your robots learn both from you.
#
# **When you have finished, you can**
#
# - let a robot draw, and read the colour of the ground,
# - follow a trail that somebody else has left,
# - tell a message of zeros from silence,
# - agree on a code, so that one robot can tell another one a place.
#
# *About 65 minutes. Before: lessons 04 and 06.*
#
# It has the last number, and can come before the project (20): your own world may have ink and messages, too.
#
# **Recap.** A robot knows what its sensors read, and nothing else. A rule turns a reading into an action.

# %% tags=["setup"]
import math

from ai4u_edu import *
from ai4u_edu.lessons import (
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
from ai4u_edu.lessons.exercises.lesson_21 import loads_home, road, tower, trail

# %% [markdown]
# ## A pen
#
# A `PenActuator` takes one number: above 0.5 the pen is down, and the robot leaves **ink** wherever it
# goes. Hold Space to draw, and drive with W A S D. The house wants to be drawn all along its grey outline.

# %%
show("draw_figure", seed=1)

# %% [markdown]
# Ink stays where it is: nobody has to be there when somebody else reads it. *Try again* keeps it; a *New
# start* gives you clean paper.
#
# A `ColourSensor` looks down at one point of the ground. Its reading has four numbers from 0 to 1: **red,
# green, blue, brightness**. White paper is light of all three colours: `[1, 1, 1, 1]`.

# %%
sim = road(lambda percept: {"move": [1, 0, 0, 0], "pen": [0]})
sim.reset(seed=1)
before = None
while not sim.agents[0].done:
    sim.step(sim.agents[0])
    reading = sim.agents[0].percept["colour"].round(2)
    if before is None or abs(reading - before).max() > 0.1:
        print(f"at {sim.agents[0].body.position[0]:5.1f} m:", reading)
    before = reading

# %% [markdown]
# Orange and blue stripes come in another order on each road. Look at the numbers. Which of the four tells
# orange from blue *and* from white? Which ones can't?
#
# ### Exercise 21.1: ink the orange stripes
#
# Drive along the road to its end, straight on. The pen has to be down over orange stripes, and up over
# everything else.


# %% tags=["exercise-21.1"]
def paint(percept):
    red, green, blue, brightness = percept["colour"]
    return {"move": [1, 0, 0, 0], "pen": [0]}


# %%
check("21.1", paint)

# %%
film(road(paint, seed=3), limit=240)

# %% [markdown]
# ## A trail
#
# The purple robot is a scout. It drives away and draws its way; nobody knows where it goes. Your robot has
# no eyes for it. It has five eyes that look down at the ground, `line`: from the leftmost to the rightmost
# one, 1 on ink and 0 beside it.
#
# ### Exercise 21.2: follow the trail
#
# Find the scout at the end of its trail, within 27 seconds. Until the first eye sees ink, drive straight
# on. (A turn above 0 goes to the right, below 0 to the left.)


# %% tags=["exercise-21.2"]
def follow(percept):
    left, half_left, middle, half_right, right = percept["line"]
    return {"move": [0.7, 0, 0, 0]}


# %%
check("21.2", follow)

# %%
film(trail(follow, seed=3), limit=330)

# %% [markdown]
# ## Ants
#
# Five ants look for food at random. Whoever has found some goes home and draws. Whoever meets a trail follows
# it away from the nest. No ant knows where the food is, none tells the others, none has a plan.
#
# In a minute they bring home some loads. How many are left if somebody wipes their ink away at once? Give
# your guess in percent of the loads with ink.

# %%
predict("21.ants", ...)

# %%
with_ink, without = loads_home(has_ink=True), loads_home(has_ink=False)
print(with_ink, "loads with ink,", without, "without")
compare("21.ants", round(100 * without / with_ink))

# %% [markdown]
# That is called *stigmergy*: working together by what each leaves in the world. A path across a lawn is
# another one.
#
# ## A message
#
# A trace waits for whoever comes by. A **message** is for now: a `SpeakActuator` says a few numbers, from -1
# to 1, to all robots in reach, and a `HearSensor` reads them in the next percept: `[heard, number 1, number
# 2]`. When nobody spoke, `heard` is 0, and so are all other numbers.
#
# ### Exercise 21.3: zero, or silence?
#
# Somebody tells your robot a place: x and y, where 1 stands for 10 metres. `hear` is the reading, and `before`
# the place that it knew until now. Return the place that it knows now, as a list: [x, y] in metres. When nobody
# spoke, it still knows the one before.


# %% tags=["exercise-21.3"]
def where(hear, before):
    heard, x, y = hear
    return before


# %%
check("21.3", where)

# %% [markdown]
# ## Two robots, one flag
#
# A tower sees a flag: `percept["flag"]` is its place, `[x, y, height]` in metres, each from -8 to 8. It
# can't move. A robot can, and it does not see the flag. It hears, and it knows where it is (`position`, in
# metres) and where it looks (`heading`: sine, cosine).


# %% tags=["setup"]
def go_to(percept, x, y):
    """Drives to a place of the field, in metres."""
    dx, dy = x - percept["position"][0], y - percept["position"][1]
    sine, cosine = percept["heading"]
    angle = math.atan2(cosine * dy - sine * dx, cosine * dx + sine * dy)
    return {"move": [1 if abs(angle) < 0.5 else 0, max(-1, min(1, -2 * angle)), 0, 0]}


# %% [markdown]
# ### Exercise 21.4: a tower that tells
#
# Write a driver for each of them: `spot` for the tower, `run` for the robot. The tower has to say something
# that the robot understands. What the numbers mean is up to you; they go from -1 to 1, and both must mean
# the same by them.


# %% tags=["exercise-21.4"]
def spot(percept):
    x, y, height = percept["flag"]
    return {"speak": [0, 0, 0]}


def run(percept):
    heard, first, second = percept["hear"]
    return go_to(percept, 0, 0)


# %%
check("21.4", spot, run)

# %%
film(tower(spot, run), limit=170)

# %% [markdown]
# ## You and a partner
#
# In `call` your partner sees when you face your flag, and you see when it faces its own. Neither of you
# sees its own one. You have no numbers, only a call: hold Space. Who calls, and when? Find a code that
# works.

# %%
show("call", seed=1)

# %% [markdown]
# ## Exit ticket
#
# Choose the best answer to each question, and write its letter into the list.
#
# **1.** What can a trace of ink do that a message can't?
#
# - a: It can be read by somebody who comes by later.
# - b: It reaches robots that are far away.
# - c: It is gone as soon as it was read.
#
# **2.** A robot reads `[0, 0, 0]` from its HearSensor. What does it know?
#
# - a: Somebody told it the place (0, 0).
# - b: Somebody spoke, but nothing of importance.
# - c: Nobody in reach has spoken.
#
# **3.** Two teams play on one field. Both say where the ball is, one in shares of 10 metres and one in
# shares of 5. A robot hears the number 0.8. What can it do with that?
#
# - a: It only hears its own team, so 0.8 is clear.
# - b: It has to know who spoke, or all have to agree on one code.
# - c: 0.8 means 8 metres.

# %% tags=["exercise-21.exit"]
answers = ["", "", ""]

# %%
check("21.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - The tower may say one number only. Can it still tell a place? How exactly?
# - A pen with several colours: `PenActuator(colours=["orange", "blue", "none"])`; its second number chooses
#   one, and "none" wipes ink away. Let a scout mark a dead end.
# - Let an ant of the scene `ants` lie: it draws a trail to nowhere. How much do five honest ones lose?
#
# **Words of this lesson:** ink, trail, stigmergy, message, code. **Next:** 20, the project, if it is still
# before you.
