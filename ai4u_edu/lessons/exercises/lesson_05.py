"""Your own controller: rules, then a state machine."""

import math
from itertools import pairwise
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    BearingSensor,
    Brain,
    LocalBrain,
    RayCastingSensor,
    RBMoveActuator,
    RewardFunc,
    Sensor,
    TouchRewardFunc,
    TouchSensor,
)
from ai4u_edu.lessons.exercise import Done, exercise
from ai4u_edu.lessons.numeric import is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import ANYWHERE
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

POSTS = ("red", "blue")
ENOUGH = 6
"""Rests at posts that are needed."""
REST_DECISIONS = 24
"""Decisions for which the robot has to stand still: 2 s."""
AT_POST_M = 1.25
"""Distance of the centres within which a robot is at a post; they touch at 1 m."""
STILL_M = 0.001
EDGE = Variation(x=(-4.3, 4.3), y=(3.4, 4.2), heading_deg=(-180, 180))
"""Places near an edge: who drives a circle blindly falls there."""
FAR_M = 4.0
"""Distance between the farthest two places that a stroll has to reach."""


def _robot(brain: Brain, sensors: list[Sensor], *rewards: RewardFunc) -> BasicAgent:
    return BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=list(rewards),
        brains=[brain],
    )


def _reacts(stroll: Any) -> bool:
    """Return True if a function's action depends on the feelers at all."""
    if isinstance(stroll, type) or not callable(stroll):
        return True
    felt = ([1, 1, 1], [0, 0, 0], [0, 1, 1], [1, 1, 0], [1, 0, 1])
    return len({repr(stroll({"feelers": each})) for each in felt}) > 1


def _length(done: Drive) -> float:
    """Return the length of the trail, metres."""
    return sum(math.dist(here, there) for here, there in pairwise(done.trail))


@exercise(
    "05.1",
    "Stay on the plate",
    hints={
        "begin": "Where `ahead` is 0 there is no floor in front: then turn on the spot, without "
        "driving.",
        "brake": "It sees the edge and turns, but drives on while it turns. In a corner that is "
        "one step too far: turn on the spot.",
        "spin": "It does not get about. While all three feelers read 1, drive.",
        "dither": "In a corner it turns left, right, left: a feeler of each side is over the "
        "void in turn. Turn the same way always, until all feelers read 1.",
        "blind": "It drives in a circle without looking. Read the feelers: go straight on while "
        "all of them read 1.",
        "towards": "It looks to one side only. The edge may come from the left, from ahead and "
        "from the right.",
    },
)
def stays_on_the_plate(stroll: Any) -> Done:
    """Check for 30 seconds and 15 metres without a fall."""
    brain = as_brain(stroll)
    feelers = RayCastingSensor(
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
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=EDGE)
    agent = _robot(LocalBrain(controller=lambda _: {}), [feelers])
    sim = ControlRequestor(world, [agent])
    agent.use_brain(brain)
    for seed in seeds_of("05.1", 10):
        turns: set[bool] = set()
        actions: set[tuple[float, ...]] = set()

        def watch(
            done: Drive, turns: set[bool] = turns, actions: set[tuple[float, ...]] = actions
        ) -> None:
            move = tuple(done.agent.last_action.get("move", (0.0, 0.0)))
            if done.steps:
                actions.add(move)
            if move[1]:
                turns.add(move[1] > 0)

        done = drive(sim, agent, seed, 360, watch)
        steady = len(actions) == 1 and bool(turns) and not _reacts(stroll)
        if done.fell:
            hint = "begin" if not turns else "brake" if len(turns) > 1 else "towards"
            hint = "blind" if steady else hint
            raise done.not_yet("The robot fell off the plate ({where}).", hint)
        if _length(done) < 15:
            raise done.not_yet(
                f"In 30 seconds the robot covered {_length(done):.1f} m, not 15 ({{where}}).",
                "dither" if len(turns) > 1 else "spin",
            )
        widest = max(math.dist(one, two) for one in done.trail[::6] for two in done.trail[::6])
        if widest < FAR_M:
            raise done.not_yet(
                f"The robot saw little of the plate: its way is {widest:.1f} m wide, expected "
                f"{FAR_M:g} ({{where}}).",
                "blind",
            )
    return Done("30 seconds in each of 10 worlds, and no fall.", done.picture())


@exercise(
    "05.2",
    "Patrol",
    hints={
        "begin": "It rests at one post, and stays there. When it has rested, set `self.goal` to "
        "the other post; and drive to the post that `self.goal` names.",
        "short": "It does not rest. Count the decisions in which it stands still, in "
        "`self.waited`: 2 seconds are 24 of them.",
        "forgets": "It never rests anywhere for 2 seconds, nor does it get from post to post. What "
        "has to last until the next decision belongs in `self`, with a value at the beginning.",
        "back": "It stays at the second post: resting there has to change the goal as well. And "
        "the count has to begin anew each time.",
    },
)
def patrols(patrol: Any) -> Done:
    """Check that it rests at the posts in turn."""
    for seed in seeds_of("05.2", 8):
        world = World()
        world.add_floor("plate", BoxShape(size=(10, 10)))
        world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=ANYWHERE)
        for name in POSTS:
            world.add_body(name, CircleShape(radius=0.5), kind="static", random=ANYWHERE)
        senses: list[Sensor] = []
        for name in POSTS:
            senses.append(BearingSensor(target=name, perception_key=f"to {name}"))
            senses.append(TouchSensor(target=name, perception_key=f"at {name}"))
        agent = _robot(as_brain(patrol), senses)
        visits = _Visits()
        done = drive(ControlRequestor(world, [agent]), agent, seed, 720, visits.watch)
        if len(visits.rested) < ENOUGH:
            shown = ", ".join(visits.rested) or "no post"
            raise done.not_yet(
                f"In a minute the robot rested 2 s at {shown}; it touched "
                f"{', '.join(visits.touched[:8]) or 'none'} ({{where}}).",
                visits.why(),
            )
    return Done(f"In 8 worlds the robot rested at {', '.join(visits.rested[:6])} ...")


class _Visits:
    """The posts that a robot touched, and at which it rested."""

    def __init__(self) -> None:
        self.touched: list[str] = []
        self.rested: list[str] = []
        self._still = 0
        self._pose = (0.0, 0.0, 0.0)

    def watch(self, done: Drive) -> None:
        """Look after a decision."""
        body = done.agent.body
        pose = (*body.position, body.heading)
        self._still = self._still + 1 if math.dist(pose, self._pose) < STILL_M else 0
        self._pose = pose
        for name in POSTS:
            if done.agent.percept[f"at {name}"][0] == 1 and self.touched[-1:] != [name]:
                self.touched.append(name)
            is_there = body.distance(done.sim.world[name]) < AT_POST_M
            if is_there and self._still >= REST_DECISIONS and self.rested[-1:] != [name]:
                self.rested.append(name)

    def why(self) -> str:
        """Return the diagnosis."""
        if self.rested:
            return "back" if len(self.rested) > 1 else "begin"
        return "short" if len(self.touched) > 3 else "forgets"


@exercise(
    "05.3",
    "Around the wall",
    hints={
        "begin": "It pushes against the wall for good. When the bumper reads 1, change the state; "
        "in the state `back off`, drive backward.",
        "again": "It backs off and drives at the same place of the wall again. It needs a third "
        "state: turn aside and drive for a while, before it seeks.",
        "forever": "It leaves the wall and does not come back. Count the decisions that are left "
        "in a state, and change the state when there are none.",
    },
)
def gets_around(machine: Any) -> Done:
    """Check that it gets to the box behind the wall."""
    for number, seed in enumerate(seeds_of("05.3", 10)):
        world = _walled(seed, has_arm=number % 2 == 1)
        bumper = TouchSensor(target="wall", perception_key="bumper")
        arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
        agent = _robot(as_brain(machine), [bumper, BearingSensor(target="box")], arrived)
        sim = ControlRequestor(world, [agent])
        bumps: list[int] = []

        def watch(done: Drive, bumps: list[int] = bumps) -> None:
            if done.agent.percept["bumper"][0] == 1:
                bumps.append(done.steps)

        done = drive(sim, agent, seed, 720, watch)
        if not is_close(agent.ledger.episode_total, 1, 1e-6):
            gaps = [later - sooner for sooner, later in pairwise(bumps)]
            hint = "again" if any(gap > 1 for gap in gaps) else "begin"
            if done.fell or (bumps and done.steps - bumps[-1] > 60):
                hint = "forever"
            raise done.not_yet("The robot did not get to the box ({where}).", hint)
    return Done("In 10 worlds the robot got around the wall.", done.picture())


def _walled(seed: int, *, has_arm: bool) -> World:
    """Return a plate with a wall between robot and box.

    The wall is 8 m long, or 6 m with an arm at one end that points to the robot's side: a curve
    drawn blindly around it ends in the corner or beyond the box.
    """
    chance = np.random.default_rng(seed)
    length = 6.0 if has_arm else 8.0
    side, shift, x = chance.choice([-1.0, 1.0]), chance.uniform(-0.7, 0.7), chance.uniform(-1, 1)
    world = World()
    world.add_floor("plate", BoxShape(size=(24, 24)))
    start = Variation(x=(-5, -3.5), y=(-1.5, 1.5), heading_deg=(-180, 180))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=start)
    place = (float(x), float(shift))
    world.add_body(
        "wall", BoxShape(size=(0.4, length)), kind="static", position=place, tags=("wall",)
    )
    if has_arm:
        end = (place[0] - 0.75, float(shift + side * length / 2))
        arm = BoxShape(size=(1.5, 0.4))
        world.add_body("arm", arm, kind="static", position=end, tags=("wall",))
    there = Variation(x=(3, 5), y=(-1, 1))
    world.add_body("box", BoxShape(size=(1, 1)), kind="static", tags=("target",), random=there)
    return world
