"""Your own controller: rules, then a state machine."""

import math
from itertools import pairwise
from typing import Any

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
"""Posts that have to be touched."""


def _robot(brain: Brain, sensors: list[Sensor], *rewards: RewardFunc) -> BasicAgent:
    return BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=list(rewards),
        brains=[brain],
    )


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
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=ANYWHERE)
    agent = _robot(LocalBrain(controller=lambda _: {}), [feelers])
    sim = ControlRequestor(world, [agent])
    agent.use_brain(brain)
    for seed in seeds_of("05.1", 10):
        turns: set[bool] = set()

        def watch(done: Drive, turns: set[bool] = turns) -> None:
            turn = done.agent.last_action.get("move", (0.0, 0.0))[1]
            if turn:
                turns.add(turn > 0)

        done = drive(sim, agent, seed, 360, watch)
        if done.fell:
            hint = "begin" if not turns else "brake" if len(turns) > 1 else "towards"
            raise done.not_yet("The robot fell off the plate ({where}).", hint)
        if _length(done) < 15:
            raise done.not_yet(
                f"In 30 seconds the robot covered {_length(done):.1f} m, not 15 ({{where}}).",
                "dither" if len(turns) > 1 else "spin",
            )
    return Done("30 seconds in each of 10 worlds, and no fall.", done.picture())


@exercise(
    "05.2",
    "Patrol",
    hints={
        "begin": "It goes to red and stays there. When it touches red, set `self.goal` to blue; "
        "and drive to the post that `self.goal` names.",
        "one": "After red it does not reach blue. The goal has to last until the next decisions: "
        "keep it in `self.goal`, and give it a value at the beginning only.",
        "back": "It gets to blue and stays there: touching blue has to change the goal as well.",
    },
)
def patrols(patrol: Any) -> Done:
    """Check that it touches the posts in turn."""
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
        sim = ControlRequestor(world, [agent])
        met: list[str] = []

        def watch(done: Drive, met: list[str] = met) -> None:
            for name in POSTS:
                if done.agent.percept[f"at {name}"][0] == 1 and met[-1:] != [name]:
                    met.append(name)

        done = drive(sim, agent, seed, 720, watch)
        if len(met) < ENOUGH:
            shown = ", ".join(met) or "none"
            hint = "begin"
            if len(met) > 1 and met[-1] == "blue":
                hint = "back"
            elif met and _length(done) > 10:
                hint = "one"
            raise done.not_yet(
                f"In a minute the robot touched these posts: {shown} ({{where}}).", hint
            )
    return Done(f"In 8 worlds the robot ran from post to post: {', '.join(met[:6])} ...")


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
    for seed in seeds_of("05.3", 10):
        world = World()
        world.add_floor("plate", BoxShape(size=(20, 20)))
        start = Variation(x=(-5, -3), y=(-1.5, 1.5), heading_deg=(-180, 180))
        world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=start)
        shift = Variation(x=(-1, 1), y=(-0.7, 0.7))
        world.add_body("wall", BoxShape(size=(0.4, 4)), kind="static", random=shift)
        there = Variation(x=(3, 5), y=(-1, 1))
        world.add_body("box", BoxShape(size=(1, 1)), kind="static", tags=("target",), random=there)
        bumper = TouchSensor(target="wall", perception_key="bumper")
        arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
        agent = _robot(as_brain(machine), [bumper, BearingSensor(target="box")], arrived)
        sim = ControlRequestor(world, [agent])
        bumps: list[int] = []

        def watch(done: Drive, bumps: list[int] = bumps) -> None:
            if done.agent.percept["bumper"][0] == 1:
                bumps.append(done.steps)

        done = drive(sim, agent, seed, 600, watch)
        if not is_close(agent.ledger.episode_total, 1, 1e-6):
            gaps = [later - sooner for sooner, later in pairwise(bumps)]
            hint = "again" if any(gap > 1 for gap in gaps) else "begin"
            if done.fell or (bumps and done.steps - bumps[-1] > 60):
                hint = "forever"
            raise done.not_yet("The robot did not get to the box ({where}).", hint)
    return Done("In 10 worlds the robot got around the wall.", done.picture())
