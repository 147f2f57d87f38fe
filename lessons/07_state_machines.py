# %% [markdown]
# # 07 State machines
#
# ![A robot that bumped into a wall, and found its way around it](pictures/07.png)
#
# A lift, a vending machine, a ghost in a video game: each is always in one of a few *states*, and something
# has to happen before it changes to another one. Robots are often built that way, because you can draw them
# before you program them.
#
# **When you have finished, you can**
#
# - draw a state machine with bubbles and arrows,
# - turn the drawing into Python,
# - say when one number in a rule is not enough,
# - write a machine as a table.
#
# *About 60 minutes. Before: lesson 06.*
#
# **Recap.** A rule sees nothing but the percept. A controller that is a class can remember, in `self`.

# %% tags=["setup"]
from ai4u_edu import *
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
from ai4u_edu.lessons.exercises.lesson_07 import battery_world, wall_world


def to(bearing):
    """The action that drives towards a bearing."""
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


def robot_in(world, controller, sensors, rewards=()):
    """A world with a robot that drives at 2 m/s and turns at 3 radians a second."""
    agent = BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=rewards,
        brains=[LocalBrain(controller=controller)],
    )
    return ControlRequestor(world, [agent], success="arrived")


# %% [markdown]
# ## Bubbles and arrows
#
# The patrol of lesson 06 had **states**, such as "to red" and "rest at red". It changed from one to
# another when something happened. That is a **state machine**. You draw it with a bubble for each state,
# and an arrow for each change. At the arrow you write what has to happen:
#
# ```
#              touches red                2 seconds later
#   (to red) --------------> (rest at red) --------------> (to blue)
#       ^                                                      | touches blue
#       +------------------------------------------- (rest at blue)
#                       2 seconds later
# ```
#
# In Python, one variable keeps the state. Each decision has two parts. First the **arrows**: does the
# state change? Then the **bubbles**: what does the robot do in this state? Here is a robot with two
# states. Each of them ends after a number of decisions, so a second variable counts how many are left.


# %%
class Square(Controller):
    """Drives straight on, turns, drives straight on ..."""

    state = "straight"
    left = 24  # decisions that are left in this state

    def get_action(self, percept):
        if self.state == "straight" and self.left == 0:  # the arrows
            self.state, self.left = "turn", 6
        elif self.state == "turn" and self.left == 0:
            self.state, self.left = "straight", 24
        self.left = self.left - 1

        if self.state == "straight":  # the bubbles
            return {"move": [1, 0, 0, 0]}
        return {"move": [0, 1, 0, 0]}


# %% [markdown]
# (`self.state, self.left = "turn", 6` sets both values in one line.)
#
# The robot turns at 3 radians a second, so 6 decisions are 1.5 radians: nearly a right angle. After how many
# decisions will it have driven four sides and made four turns? Guess, then watch.

# %%
predict("07.1", ...)

# %%
plate = World()
plate.add_floor("plate", BoxShape(size=(10, 10)))
plate.add_body("robot", CircleShape(radius=0.5), position=(-2, 2))
film(robot_in(plate, Square(), []), limit=120)
compare("07.1", 4 * (24 + 6))

# %% [markdown]
# ## A wall in the way
#
# A long wall stands between robot and box; some walls have a corner, like an L. The robot has a bumper,
# which reads 1 while it touches the wall. It also knows the bearing of the box, as if it could smell the box
# through the wall. A rule would push against the wall for ever. In some worlds the wall is not in the way:
# there the robot should drive straight to the box. Here is a machine:
#
# ```
#            bumps                6 decisions later            20 decisions later
#   (seek)  -------->  (back off) ------------------> (aside) --------------------> (seek)
# ```
#
# In the state "aside", the robot first turns to one side for some decisions, and drives straight on for
# the rest.
#
# ### Exercise 07.1: around the wall
#
# Write the machine of the drawing, or one of your own. Begin with the arrows. The robot has to read its
# bumper: it must not push against the wall for longer than a second.


# %% tags=["exercise-07.1"]
class AroundTheWall(Controller):
    """Gets to the box, although there is a wall in its way."""

    state = "seek"
    left = 0  # decisions that are left in this state

    def get_action(self, percept):
        bumps = percept["bumper"][0] == 1
        if self.state == "seek":
            return to(percept["bearing"])
        return {"move": [0, 0, 0, 0]}


# %%
check("07.1", AroundTheWall)

# %%
senses = [TouchSensor(target="wall", perception_key="bumper"), BearingSensor(target="box")]
arrived = [TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)]
film(robot_in(wall_world(3, has_arm=True), AroundTheWall(), senses, arrived), seed=3, limit=720)

# %% [markdown]
# If it does not get there, find out in which state it is: put `print(self.state)` into the method, and
# run the film again.
#
# ## When one number is not enough
#
# This robot has a battery. It works at the orange site and charges at the green station, 8 to 10 metres away.
# `percept["battery"][0]` goes from 1 (full) to 0 (empty). A rule could be: *below 0.4 drive to the station,
# otherwise work.* What will the battery look like over two minutes? Sketch it on paper, then run the cell.


# %%
def one_number(percept):
    if percept["battery"][0] < 0.4:
        return to(percept["to station"])
    return to(percept["to site"])


def battery_of(controller):
    """The level of the battery at each decision, and the decisions at the site."""
    sim = battery_world(controller)
    sim.reset(seed=1)
    levels, at_work = [], 0
    for _ in range(1440):
        levels.append(float(sim.step()["battery"][0]))
        at_work += sim.world["robot"].distance(sim.world["site"]) < 1.25
    print("at the site for", round(at_work / 12), "of 120 seconds")
    return levels


plot({"battery": battery_of(one_number)}, xlabel="decision", ylabel="level of the battery")

# %% [markdown]
# At 0.4 the robot turns round, charges for a moment, is above 0.4 again, leaves, is below 0.4 ... It is
# on the road nearly all the time. It needs **two** numbers: one at which it goes to the station, and
# another one at which it leaves. In between, at 0.6 say, it does one thing or the other. Which one
# depends on what it was doing before, and that is its state. (A heater works like that, too: on below 19
# degrees, off above 21. There is a way without a variable for the state: in between, drive on to the place
# that the robot faces. Then its heading is its memory.)
#
# ```
#             battery low
#   (work) ------------------> (charge)
#      ^                           |
#      +---------------------------+
#           battery nearly full
# ```
#
# ### Exercise 07.2: the battery
#
# Write the machine of the drawing. In two minutes the robot has to be at the site for at least **30
# seconds**, and its battery must never be empty. The way to the station costs up to a quarter of the battery.
# Stations charge at different speeds, and one becomes slower or faster after a minute: so the robot has to
# read its battery, and leave within 3 seconds once it is full.


# %% tags=["exercise-07.2"]
class Worker(Controller):
    """Works, and charges its battery in time."""

    state = "work"

    def get_action(self, percept):
        battery = percept["battery"][0]
        return to(percept["to site"])


# %%
check("07.2", Worker)

# %%
plot({"battery": battery_of(Worker())}, xlabel="decision", ylabel="level of the battery")

# %% [markdown]
# ## A machine as a table
#
# With ten states, all those `if` and `elif` get long, and mistakes hide in them. But a machine is nothing
# but its arrows. Put them into a *dictionary*: for a pair of state and event, it says which state comes
# next. Here is a turnstile at a station. If there is no arrow for an event, the state stays as it is.

# %%
turnstile = {
    ("closed", "coin"): "open",
    ("open", "person passes"): "closed",
}


def run(arrows, state, events):
    for event in events:
        state = arrows.get((state, event), state)  # the next state, or the same one
        print(event, "->", state)


run(turnstile, "closed", ["person passes", "coin", "coin", "person passes"])

# %% [markdown]
# ### Exercise 07.3: a machine as a table
#
# This guard begins in the state `"patrol"`. The events are `"noise"`, `"quiet"`, `"thief"` (it sees a thief)
# and `"gone"` (the thief is gone). Write the table of the drawing.
#
# ```
#                noise                     thief
#   (patrol) --------------> (listen) --------------> (chase)
#      | ^                      | ^                     ^ |
#      | +---------quiet--------+ +---------gone--------|-+
#      |                                                |
#      +-------------------thief------------------------+
# ```


# %% tags=["exercise-07.3"]
arrows = {
    ("patrol", "noise"): "listen",
}

# %%
check("07.3", arrows)

# %%
run(arrows, "patrol", ["noise", "quiet", "thief", "noise", "gone", "thief"])

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A lift stands at floor 2 with open doors. Somebody presses the button for floor 5. What does the
# lift need to know, besides the button, to do the right thing?
#
# - a: nothing: a rule for the button is enough
# - b: its state: the doors have to close first
# - c: how many people are inside
#
# **2.** A heater is switched on below 20 degrees, and off at 20 degrees or above. It clicks on and off
# every few seconds. What helps?
#
# - a: two numbers: on below 19, off above 21, and a state for what is between
# - b: a more exact thermometer
# - c: another single number, such as 25
#
# **3.** A robot of 07.1 backs off from the wall and never does anything else. What is missing in its machine?
#
# - a: an arrow that leads to "back off"
# - b: the state "seek"
# - c: an arrow that leads from "back off" to another state

# %% tags=["exercise-07.exit"]
answers = ["", "", ""]

# %%
check("07.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Where does your machine of 07.1 go wrong? Think of a dead end, like a deep U. Build it with
#   `add_body`, and improve the machine.
# - Write a creature with three states: it sleeps, it is hungry and looks for food, it eats. Let a friend
#   watch it and guess the drawing.
# - Draw the machine of a traffic light with a button for people who want to cross.
#
# **Words of this lesson:** state, state machine, event, table of arrows. **Next:** 08, in which you slow
# down time, and look into a single decision.
