# %% [markdown]
# # 05 Your own controller: rules, then a state machine
#
# ![A robot that bumped into a wall, and found its way around it](pictures/05.png)
#
# "If the light is red, stop." A rule like that takes no thinking and no memory. How far do rules get you?
# And what can't they do?
#
# **When you have finished, you can**
#
# - write a controller as a list of rules, in the right order,
# - give a controller a memory,
# - draw a state machine, and turn it into Python,
# - say which tasks no controller without memory can solve.
#
# *About 100 minutes. Before: lesson 04.*
#
# **Recap.** A controller turns a percept into an action. Two wires can be enough for that.

# %% tags=["setup"]
from ai4u_edu import *
from ai4u_edu.lessons import check, film, hint, plot, progress, report, show, solution

ANYWHERE = Variation(x=(-3.5, 3.5), y=(-3.5, 3.5), heading_deg=(-180, 180), clearance=1)


def room(controller, sensors, **bodies):
    """A plate of 10 by 10 metres with a robot and other bodies, each somewhere."""
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), random=ANYWHERE)
    for name, shape in bodies.items():
        world.add_body(name, shape, kind="static", random=ANYWHERE)
    agent = BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        brains=[LocalBrain(controller=controller)],
    )
    return ControlRequestor(world, [agent])


def feelers():
    """Three rays that look down at the floor: left, ahead, right."""
    return RayCastingSensor(
        perception_key="feelers",
        rows=1,
        columns=3,
        field_of_view=140,
        vertical_field_of_view=1,
        vertical_shift=27,
        vision_max_distance=2,
        group_code={"floor": 1},
        flattened=True,
    )


# %% [markdown]
# ## Rules
#
# This robot has three feelers: rays that look down at the floor in front of it, one to the left, one
# ahead, one to the right. Each reads **1** where there is floor and **0** where there is none.
#
# A controller made of rules is a list of questions. The first one that fits decides:
#
# ```
# if something is urgent:   do this
# if something else holds:  do that
# otherwise:                go on
# ```
#
# The **order** matters. "Don't fall" has to come before "go ahead". Engineers say that such a rule has
# higher *priority*.

# %%
film(room(lambda percept: {"move": [1, 0, 0, 0]}, [feelers()]), seed=1)

# %% [markdown]
# ### Exercise 05.1: stay on the plate
#
# Let the robot stroll about for 30 seconds without falling. It begins near an edge. It must not just
# stand, spin or drive in a small circle: it has to cover at least 15 metres, and get 4 metres away.


# %% tags=["exercise-05.1"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    return {"move": [1, 0, 0, 0]}


# %%
check("05.1", stroll)

# %%
film(room(stroll, [feelers()]), seed=1, limit=150)

# %% [markdown]
# ## What rules can't do
#
# Two posts stand on the plate, a red one and a blue one. The robot is a guard: it drives to red, stands
# still there for **2 seconds**, drives to blue, stands still for 2 seconds, and so on. It senses the
# bearing of both posts, and whether it touches one.
#
# Think of the robot standing at the red post. Nothing moves, so **the percept is the same at every
# decision**: after a tenth of a second, after one second, after two. A rule sees the percept alone, so it
# gives the same answer each time. If the answer is "stand still", the robot stands there for ever; if it
# is "go", the robot never rests. No rule can do this. It takes a **memory**: somebody has to count.
#
# (What about running between the posts without a rest? Rules can do that. The post you come from is
# behind you, so the percept is *not* the same on the way there and on the way back. Find such a rule, if
# you like.)
#
# A controller with a memory is a **class**: a plan for an object that keeps its own values. `class
# Counter(Controller)` means: a Counter is a kind of Controller. The line `count = 0` gives the value at
# the start. `get_action` is called at each decision, and `self` is the object itself: `self.count` is
# *its* count, and lasts until the next decision. (A name without `self` is forgotten when the function
# returns.)


# %%
class Counter(Controller):
    """Counts its decisions, and turns around after each twenty."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        if self.count % 40 < 20:
            return {"move": [1, 0, 0, 0]}
        return {"move": [0, 1, 0, 0]}


film(room(Counter(), [feelers()]), seed=2, limit=100)

# %% [markdown]
# ### Exercise 05.2: patrol
#
# Rest at red, at blue, at red, and so on: at least six rests of 2 seconds (24 decisions) in a minute.
# `to` is a helper that drives towards a bearing.


# %% tags=["setup"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["exercise-05.2"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0  # decisions for which it has stood still

    def get_action(self, percept):
        touches_red = percept["at red"][0] == 1
        touches_blue = percept["at blue"][0] == 1
        return to(percept["to red"])


# %%
check("05.2", Patrol)

# %%
posts = [
    BearingSensor(target="red", perception_key="to red"),
    BearingSensor(target="blue", perception_key="to blue"),
    TouchSensor(target="red", perception_key="at red"),
    TouchSensor(target="blue", perception_key="at blue"),
]
post = CircleShape(radius=0.5)
show(room(Patrol(), posts, red=post, blue=post), seed=1)

# %% [markdown]
# ## State machines
#
# What you have built has **states**, such as "to red" and "resting at red", and it changes from one to
# another when something happens. That is a *state machine*. Lifts, vending machines and the creatures in
# many games are built like that. You draw it with a bubble for each state, and an arrow for each change:
#
# ```
#              touches red                2 seconds later
#   (to red) --------------> (rest at red) --------------> (to blue)
#       ^                                                      | touches blue
#       +------------------------------------------- (rest at blue)
#                       2 seconds later
# ```
#
# Now a harder one. A long wall stands between robot and box; some walls have a corner, like an L. The
# robot has a bumper, which reads 1 while it touches the wall; and it knows the bearing of the box, as if
# it could smell it through the wall.
#
# ```
#            bumps                6 decisions later            14 decisions later
#   (seek)  -------->  (back off) ------------------> (aside) --------------------> (seek)
# ```
#
# ### Exercise 05.3: around the wall
#
# Write the machine of the drawing, or one of your own. A state that ends after a while needs a counter.


# %% tags=["exercise-05.3"]
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
check("05.3", AroundTheWall)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Where does your machine go wrong? Think of a dead end, like a U. Build it, and improve the machine.
# - Write a creature with three states of its own: it sleeps, it is hungry and looks for food, it eats.
#   Let a friend guess the drawing from watching it.
# - `line_follow` is a scene of the library: a robot that follows a line. Off the line all its eyes read
#   0. What does it have to remember to come back? Write the controller: `show("line_follow",
#   brain=your_function)`.
#
# **Words of this lesson:** rule, priority, memory, state, state machine. **Next:** 06, in which you slow
# down time, and look into a single decision.
