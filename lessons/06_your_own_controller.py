# %% [markdown]
# # 06 Your own controller: rules and memory
#
# ![A robot's way across a plate, always away from the edge](pictures/06.png)
#
# "If the light is red, stop." A rule like that takes no thinking and no memory. How far do rules get you?
# And what can't they do?
#
# **When you have finished, you can**
#
# - write a controller as a list of rules, in the right order,
# - write a class with a method, and say what `self` is,
# - give a controller a memory,
# - say which tasks no controller without memory can solve.
#
# *About 60 minutes without the gold exercise. Before: lesson 05.*
#
# **Recap.** A controller turns a percept into an action. Two wires can be enough for that.

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

COLOURS = {"red": "vermillion", "blue": "blue"}
ANYWHERE = Variation(x=(-3.5, 3.5), y=(-3.5, 3.5), heading_deg=(-180, 180), clearance=1)


def room(controller, sensors, **bodies):
    """A plate of 10 by 10 metres with a robot and other bodies, each somewhere."""
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), random=ANYWHERE)
    for name, shape in bodies.items():
        colour = COLOURS.get(name, "grey")
        world.add_body(name, shape, kind="static", random=ANYWHERE, colour=colour, label=name)
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
#
# Without any rule the robot falls. (`lambda percept: ...` is a small function without a name: it always
# drives ahead.)

# %%
film(room(lambda percept: {"move": [1, 0, 0, 0]}, [feelers()]), seed=1)

# %% [markdown]
# ### Exercise 06.1: stay on the plate
#
# Let the robot stroll about for 30 seconds without falling. It begins near an edge. It must not just
# stand, spin or drive in a small circle: it has to cover at least 15 metres, and get 4 metres away.


# %% tags=["exercise-06.1"]
def stroll(percept):
    left, ahead, right = percept["feelers"]
    return {"move": [1, 0, 0, 0]}


# %%
check("06.1", stroll)

# %%
film(room(stroll, [feelers()]), seed=1, limit=150)

# %% [markdown]
# ## What rules can't do
#
# Two posts stand on the plate, a red one and a blue one. The robot is a guard: it drives to red, stands
# still there for **2 seconds**, with its wheels at zero, drives to blue, stands still for 2 seconds, and so
# on. It senses the bearing of both posts, and whether it touches one.
#
# Think of the robot as it stands at the red post. Nothing moves, so **the percept is the same at every
# decision**: after a tenth of a second, after one second, after two. A rule sees nothing but the percept,
# so it gives the same answer each time. If the answer is "stand still", the robot stands there for ever;
# if it is "go", the robot never rests. No rule can do this. It takes a **memory**: somebody has to count.
# (A robot that turns by a hair at each decision could read the bearing like the hand of a clock. But then
# it does not stand still.)
#
# (Running between the posts without a rest is different. Rules can do that, because the post that you
# come from is behind you: the percept is *not* the same on the way there and on the way back.)
#
# ## A class, and `self`
#
# A function forgets its variables as soon as it returns. To remember something we need an object that keeps
# values, and so a **class**, the plan for such objects. You have used classes since lesson 03; now you write
# one. Here are two door bells:


# %%
class Bell:
    rung = 0

    def ring(self):
        self.rung = self.rung + 1
        return "ding " * self.rung


front = Bell()
back = Bell()
print(front.ring())
print(front.ring())

# %% [markdown]
# What will `back.ring()` return? Guess how many dings there will be.

# %%
predict("06.1", ...)

# %%
dings = back.ring()
print(dings)
compare("06.1", dings.count("ding"))

# %% [markdown]
# - `Bell()` builds a bell by the plan. We built two, and each keeps its own count.
# - `rung = 0` is the value that each bell has at the start.
# - A function in a class is called a **method**. `self` is the object whose method was called: in
#   `front.ring()` it is `front`. You write `self` in the definition, but never in the call.
# - `self.rung` belongs to the object, and lasts. A name without `self.` is forgotten when the method returns.
#
# A controller is a class as well. `class Counter(Controller)` means: a Counter is a kind of Controller.
# It has all that a Controller has, and we write only what is different: the method `get_action`, which is
# called at each decision.


# %%
class Counter(Controller):
    """Drives for twenty decisions, then turns for twenty, and so on."""

    count = 0

    def get_action(self, percept):
        self.count = self.count + 1
        if self.count % 40 < 20:
            return {"move": [1, 0, 0, 0]}
        return {"move": [0, 1, 0, 0]}


film(room(Counter(), [feelers()]), seed=5, limit=100)

# %% [markdown]
# (`%` gives the remainder of a division: `self.count % 40` counts from 0 to 39, again and again.)
#
# ### Exercise 06.2: patrol
#
# Rest at red, at blue, at red, and so on: at least six rests of 2 seconds (24 decisions) in a minute.
# Standing still means an action of zeros: an empty action, `{}`, leaves the motor as it is. In each world
# the posts are another way apart, and a robot that touches one must not push against it for longer than a
# second.
# `to` is a helper that drives towards a bearing. Two things have to last: where the robot is going
# (`self.goal`), and for how long it has stood there (`self.waited`).


# %% tags=["setup"]
def to(bearing):
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["exercise-06.2"]
class Patrol(Controller):
    """Guards the posts."""

    goal = "red"
    waited = 0  # decisions for which it has stood still

    def get_action(self, percept):
        touches_red = percept["at red"][0] == 1
        touches_blue = percept["at blue"][0] == 1
        return to(percept["to red"])


# %%
check("06.2", Patrol)

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
# ### Exercise 06.3: three bumps
#
# A smaller task, and this time you make the plan. The robot stands between two walls, and its bumper is its
# only sensor. It drives forward until it bumps, then backward until it bumps, then forward again. After the
# **third bump** it stops, and stays where it is. In each world the walls are in different places, and the
# robot must not push against a wall for more than 3 decisions. What does it have to remember?


# %% tags=["exercise-06.3"]
class ThreeBumps(Controller):
    """Drives to and fro, and rests after the third bump."""

    speed = 1

    def get_action(self, percept):
        bumps_now = percept["bumper"][0] == 1
        return {"move": [self.speed, 0, 0, 0]}


# %%
check("06.3", ThreeBumps)

# %% [markdown]
# ### Exercise 06.4: gold: a fast stroll
#
# *For fast finishers; optional.* At full speed the robot could cover 60 metres in 30 seconds. The
# usual `stroll` covers 51, as it stops each time to turn. Cover **55 metres** in every world, without a
# fall.


# %% tags=["exercise-06.4"]
def quick_stroll(percept):
    left, ahead, right = percept["feelers"]
    return {"move": [1, 0, 0, 0]}


# %%
check("06.4", quick_stroll)

# %% [markdown]
# ## Exit ticket
#
# Three questions to see what has stuck. Write your three letters into the list.
#
# **1.** A controller has these two rules, in this order. The robot is at the edge, and its battery is
# low. What does it do?
#
# ```python
# if battery < 0.2:
#     return drive_home
# if edge_ahead:
#     return turn
# ```
#
# - a: it turns, because that is more urgent
# - b: it drives home, and perhaps over the edge
# - c: first it turns, and in the same decision it drives home
#
# **2.** Which of these tasks needs a memory?
#
# - a: stop in front of a wall
# - b: turn away from an edge on either side
# - c: stand still for 3 seconds at each lamp
#
# **3.** In a method, a student writes `waited = waited + 1`, without `self.`, to count decisions. What is
# wrong?
#
# - a: a name without `self.` does not last from one decision to the next
# - b: nothing, as long as `waited` is a number
# - c: a method must not contain a `+`

# %% tags=["exercise-06.exit"]
answers = ["", "", ""]

# %%
check("06.exit", answers)

# %%
progress()

# %% [markdown]
# ## Stretch
#
# - Write a guard that also remembers how many rounds it has made, and rests for good after three of them.
# - `line_follow` is a scene of the library: a robot that follows a line. Off the line all its eyes read
#   0. What does it have to remember to come back? Write the controller: `show("line_follow",
#   brain=your_controller)`.
# - What is the least that you have to remember to find your way home from school? Which of it is a count,
#   which a place, and which the last thing that you saw?
#
# **Words of this lesson:** rule, priority, memory, class, method, `self`. **Next:** 07, in
# which you draw a robot's memory with bubbles and arrows.
