# %% [markdown]
# # 08 The decision cycle
#
# ![A robot that stopped in time before the edge](pictures/08.png)
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
# *About 75 minutes. Before: lesson 06.*
#
# **Recap.** A controller turns each percept into an action. It may keep a memory.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.learn.training import vary
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
    sliders,
    solution,
)


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
# Run the cell, open the panel, and choose **Details** at its top. Now there is **Speed**: choose **0.1x**,
# and drive. Scroll down to **Action**. Its first line shows where in the cycle the agent is, and which of
# the 5 ticks this is.

# %%
show("box_chase", seed=4)

# %% [markdown]
# ### Exercise 08.1: blind
#
# Between two decisions an agent is blind: whatever happens, it carries on with what it decided. The world
# ticks 60 times a second, and `skip_frame` ticks pass without thinking. How many **metres** does a robot
# drive from one decision to the next, at `speed` metres a second?


# %% tags=["exercise-08.1"]
def blind_way(speed, skip_frame):
    return 0


# %%
check("08.1", blind_way)

# %% [markdown]
# ## Slow thinkers
#
# This robot drives at 3 metres a second along a runway. Its feeler looks down at the floor 0.98 m ahead
# of the robot's middle. As soon as there is no floor, it stops:


# %% tags=["setup"]
def careful(percept):
    if percept["feeler"][0] == 0:
        return {"move": [0, 0, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% [markdown]
# We let it drive with `skip_frame=4`, and then with `skip_frame=29`: two decisions a second. Will it
# fall? Write `"yes"` or `"no"` for each of them.

# %%
predict("08.1", [..., ...])

# %%
fell = []
for skip_frame in (4, 29):
    sim = runway(careful, skip_frame)
    sim.reset()
    for _ in range(600 // (skip_frame + 1)):
        sim.step()
    print("skip_frame", skip_frame, "- fell:", sim.world["robot"].fallen)
    fell.append("yes" if sim.world["robot"].fallen else "no")
compare("08.1", fell)

# %% [markdown]
# With `skip_frame=29` it still sees floor ahead, drives on for half a second, and then there is none.
#
# Why don't we let all agents decide at every tick, then? Because thinking costs time. A large neural
# network may need a tenth of a second for a decision. And a learning agent learns faster if each of its
# decisions makes a difference that it can notice.
#
# Here is a controller that thinks a lot before each step. It does not follow rules, it **searches**: it
# tries all ways through the map in its head, first those of one step, then those of two steps, and so on,
# until one of them ends at a dirty place. That is called *breadth-first search*, and the first way that
# it finds is a shortest one. The scene has `skip_frame=9`, six decisions a second. That leaves time to
# think.

# %%
film("grid_world", BreadthFirstController(), seed=1)

# %% [markdown]
# ### Exercise 08.2: as lazy as possible
#
# Find a large `skip_frame` with which the careful robot still **never** falls, wherever it starts. Compute it
# from exercise 08.1, or try it out: the runway begins at x = -10 and ends at x = 10.


# %% tags=["exercise-08.2"]
skip_frame = 4

# %%
check("08.2", skip_frame)

# %% [markdown]
# **Without code.** The same with a slider. **Try** shows one drive, **Check** checks the exercise.

# %%
sliders("08.2", lambda skip_frame: round(skip_frame), skip_frame=(0, 40))

# %% [markdown]
# ## Once, or again and again?
#
# While an agent is blind, its actuators act at each tick with the same action. With
# `repeat_action=False` they act at the **first** tick only, and the robot rolls on by itself. What will
# the two ways look like? Sketch them first: here it drives for two seconds, and 1 means 2 m/s.


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
    print(
        "decision",
        agent.steps + 1,
        "is over, the robot is at x =",
        round(agent.body.position[0], 2),
    )


sim.reset()
for _ in range(3):
    sim.step()

# %% [markdown]
# There are ten events. These six come once in an episode, or once in a decision:
#
# | event | when |
# |---|---|
# | `agent_start` | the agent was put into its world; once in its life |
# | `before_the_reset` | a new episode is about to begin |
# | `begin_of_episode` | a new episode has begun |
# | `begin_of_step` | a decision was taken, and is about to be carried out |
# | `end_of_step` | the decision is over, and the rewards are paid |
# | `end_of_episode` | the episode is over |
#
# And these four come before and after a part of the cycle:
#
# | event | when |
# |---|---|
# | `begin_of_update_state`, `end_of_update_state` | before and after the sensors read |
# | `begin_of_apply_action`, `end_of_apply_action` | before and after an actuator acts: at **each tick** |
#
# With `skip_frame=4` a decision has five ticks. So how often will `begin_of_apply_action` come in three
# decisions? Guess, then count.

# %%
predict("08.2", ...)

# %%
sim = runway(go)
acts = []
sim.agents[0].begin_of_apply_action.connect(lambda agent: acts.append("act"))
sim.reset()
for _ in range(3):
    sim.step()
compare("08.2", len(acts))

# %% [markdown]
# ### Exercise 08.3: a diary
#
# Write `diary`. It gets an agent, connects what it needs, and returns a list. It appends `"begin"` when
# an episode begins, `"decision"` once for each decision, and `"end"` when the episode is over.


# %% tags=["exercise-08.3"]
def diary(agent):
    notes = []
    return notes


# %%
check("08.3", diary)

# %% [markdown]
# ## Try many: how seldom is too seldom?
#
# `vary` changes one number of a scene, and lets a driver drive from the same 20 starts with each value. Here a
# trained network drives to the box, and decides more and more seldom. Which column will change first, and with
# which `skip_frame` will it begin to fail? Guess, then run the cell.

# %%
vary("zoo", "box_chase", "brain.skip_frame", [4, 19, 29, 39])

# %% [markdown]
# `success` is how often it reached the box, and the next column says where the true share probably lies: with
# 20 other starts it would be a bit different. A robot that is slower could be as safe with fewer decisions.
# Is it? Vary `"move_amount"`, its speed, in place of `"brain.skip_frame"`: 1, 2.5, 5, 10.

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A robot drives at 2 m/s and decides with `skip_frame=29`. How far does it drive from one decision
# to the next?
#
# - a: 0.97 metres
# - b: 58 metres
# - c: 1 metre
#
# **2.** A robot drives twice as fast as before. How should it decide, so that it is as safe as before?
#
# - a: as often as before
# - b: twice as often
# - c: half as often, because it gets there sooner
#
# **3.** You connect a function to `end_of_step` that prints a line. An episode takes 10 decisions of 5
# ticks each. How many lines do you get?
#
# - a: 50
# - b: 1
# - c: 10

# %% tags=["exercise-08.exit"]
answers = ["", "", ""]

# %%
check("08.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - People need about 0.2 seconds to react. Which `skip_frame` is that? Set the `delay` of a sensor so that
#   the robot is as slow as you, and drive a race against it.
# - Which of your earlier controllers still works with `skip_frame=30`? Try the patrol of lesson 06.
# - Count with events how many ticks and how many decisions an episode has. Divide one by the other: what
#   do you get?
#
# **Words of this lesson:** tick, decision cycle, skip_frame, event, to connect. **Next:** 09, in which you
# say what you want, and get what you said.
