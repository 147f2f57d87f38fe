# %% [markdown]
# # 06 The decision cycle
#
# ![A robot that stopped in time before the edge](pictures/06.png)
#
# How often does a robot think? Sixty times a second, or once? Today you slow time down and look into a
# single decision.
#
# **When you have finished, you can**
#
# - name the four steps of a decision: sense, decide, act, reward,
# - say how far a robot drives before it looks again,
# - choose how often an agent decides, and say what it costs,
# - listen to what happens inside an agent.
#
# *About 60 minutes. Before: lesson 05.*
#
# **Recap.** A controller turns each percept into an action. It may keep a memory.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import check, film, hint, plot, progress, report, show, solution


def runway(controller, skip_frame=4, repeat_action=True, speed=3, start=-9.0):
    """A long plate, a robot that looks to the right, and a feeler that looks down ahead of it."""
    world = World()
    world.add_floor("runway", BoxShape(size=(20, 4)))
    world.add_body("robot", CircleShape(radius=0.5), position=(start, 0))
    feeler = RayCastingSensor(
        perception_key="feeler",
        rows=1,
        columns=1,
        vertical_field_of_view=1,
        vertical_shift=27,
        vision_max_distance=2,
        group_code={"floor": 1},
        flattened=True,
    )
    brain = LocalBrain(controller=controller, skip_frame=skip_frame, repeat_action=repeat_action)
    agent = BasicAgent(
        body="robot",
        sensors=[feeler, PositionSensor(normalized=False)],
        actuators=[RBMoveActuator(move_amount=speed, turn_amount=3)],
        brains=[brain],
    )
    return ControlRequestor(world, [agent])


def go(percept):
    return {"move": [1, 0, 0, 0]}


# %% [markdown]
# ## Four steps
#
# The world's clock ticks 60 times a second. An agent does not decide at each tick. It goes around in a
# cycle:
#
# ```
# sense    every sensor reads once
# decide   the controller gets the percept and gives an action
# act      the world ticks, skip_frame + 1 times, and the action is carried out
# reward   every reward function is asked, once
# ```
#
# The number `skip_frame` says how many ticks pass without thinking. With `skip_frame=4`, as in most of
# our scenes, a decision takes 5 ticks, so there are 60 / 5 = 12 decisions a second.
#
# Run the cell, open the panel, choose the speed **0.1x**, and drive. Watch the strip with the four steps:
# it shows where in the cycle the agent is.

# %%
show("box_chase", seed=4)

# %% [markdown]
# ### Exercise 06.1: blind
#
# Between two decisions an agent is blind: whatever happens, it carries on with what it decided. How many
# **metres** does a robot drive from one decision to the next, at `speed` metres a second?


# %% tags=["exercise-06.1"]
def blind_way(speed, skip_frame):
    return 0


# %%
check("06.1", blind_way)

# %% [markdown]
# ## Slow thinkers
#
# This robot drives at 3 metres a second along a runway. Its feeler looks down 0.98 m ahead of its
# middle. As soon as there is no floor, it stops:


# %% tags=["setup"]
def careful(percept):
    if percept["feeler"][0] == 0:
        return {"move": [0, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %%
for skip_frame in (4, 40):
    sim = runway(careful, skip_frame)
    sim.reset()
    for _ in range(300 // (skip_frame + 1)):
        sim.step()
    print("skip_frame", skip_frame, "- fell:", sim.world["robot"].fallen)

# %% [markdown]
# Why don't we let all agents decide at every tick, then? Because thinking costs time. A large neural
# network may need a tenth of a second for a decision; and a learning agent learns faster if its decisions
# make a difference that it can notice.
#
# ### Exercise 06.2: as lazy as possible
#
# Find a large `skip_frame` with which this robot still **never** falls, wherever it starts. Compute it
# from exercise 06.1, or try it out: the runway begins at x = -10 and ends at x = 10.


# %% tags=["exercise-06.2"]
skip_frame = 4

# %%
check("06.2", skip_frame)

# %% [markdown]
# ## Once, or again and again?
#
# While an agent is blind, its actuators act at each tick with the same action. With
# `repeat_action=False` they act at the **first** tick only, and the robot rolls on by itself. What will
# the two ways look like? Draw your guess first.


# %%
def way(repeat_action):
    sim = runway(go, skip_frame=19, repeat_action=repeat_action, speed=2)
    sim.reset()
    places = []
    for _ in range(120):
        places.append(sim.world["robot"].position[0] + 9)
        sim.tick()
    return places


plot(
    {"repeat_action=True": way(True), "repeat_action=False": way(False)},
    xlabel="tick (60 a second)",
    ylabel="way in metres",
)

# %% [markdown]
# ## Events
#
# An agent announces what it does. Each announcement is an **event**; to listen, **connect** a function to
# it. (The line with `@` connects the function below it; `agent.end_of_step.connect(told)` would do the
# same.)

# %%
sim = runway(go)
agent = sim.agents[0]


@agent.end_of_step.connect
def told(agent):
    print("decision", agent.steps, "is over, the robot is at x =", agent.body.position[0])


sim.reset()
for _ in range(3):
    sim.step()

# %% [markdown]
# | event | when |
# |---|---|
# | `begin_of_episode` | a new episode has begun |
# | `begin_of_step` | a decision was taken, and is about to be carried out |
# | `begin_of_apply_action` | an actuator is about to act: at each tick |
# | `end_of_step` | the decision is over, and the rewards are paid |
# | `end_of_episode` | the episode is over |
#
# There are ten; the others are listed in `ai4u_edu.agent.events`.
#
# ### Exercise 06.3: a diary
#
# Write `diary`. It gets an agent, connects what it needs, and returns a list. It appends `"begin"` when
# an episode begins, `"decision"` once for each decision, and `"end"` when the episode is over.


# %% tags=["exercise-06.3"]
def diary(agent):
    notes = []
    return notes


# %%
check("06.3", diary)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - People need about 0.2 seconds to react. Which `skip_frame` is that? Set the `delay` of a sensor so that
#   the robot is as slow as you, and drive a race against it.
# - Which of your earlier controllers still works with `skip_frame=30`? Try the patrol of lesson 05.
# - Count with events how many ticks and how many decisions an episode has. Divide one by the other: what
#   do you get?
#
# **Words of this lesson:** tick, decision cycle, skip_frame, event, to connect. **Next:** 07, in which you
# say what you want, and get what you said.
