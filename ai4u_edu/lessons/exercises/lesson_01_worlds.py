"""Worlds and drives of the exercises on Python."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    Brain,
    LightSensor,
    LocalBrain,
    RBMoveActuator,
    RewardFunc,
    TouchRewardFunc,
)
from ai4u_edu.lessons.numeric import is_close
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.lessons.rollouts import Drive, drive
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.world import BoxShape, CircleShape, World

TOP_SPEED = 8.0
"""Speed of the robot in 01.1 for an action of 1, m/s."""
DECISIONS_A_SECOND = 12
NEAR_M = 2.0
"""Distance below which a post in 01.4 is near."""
STEP_DECISIONS = 6
"""Decisions for a word of a plan in 01.5: a metre, or a quarter turn."""
LIGHT_REACH_M = 4.0
EYES = {"left": 60.0, "right": -60.0}
"""Directions of the eyes in 01.6, degrees."""
WORDS = {
    "forward": [1.0, 0.0, 0.0, 0.0],
    "left": [0.0, -1.0, 0.0, 0.0],
    "right": [0.0, 1.0, 0.0, 0.0],
}
"""Actions for the words of a plan."""


def race(speed: float, distance: float, seconds: int) -> Drive:
    """Drive at a speed for a time, on a plate with a line at a distance."""
    share = max(-1.0, min(1.0, speed / TOP_SPEED))
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 4)), position=(4, 0))
    line = BoxShape(size=(0.15, 3))
    world.add_area("line", line, position=(distance, 0), colour="black", paint=True)
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",))
    agent = robot_with(LocalBrain(controller=lambda _: {"move": [share, 0, 0, 0]}), move=TOP_SPEED)
    return drive(ControlRequestor(world, [agent]), agent, 1, seconds * DECISIONS_A_SECOND)


def robot_with(
    brain: Brain,
    *,
    move: float,
    turn: float = 3.0,
    eyes: Sequence[LightSensor] = (),
    goal: str = "",
) -> BasicAgent:
    """Return a robot.

    Args:
        brain: its brain.
        move: speed for an action of 1, m/s.
        turn: turning speed for an action of 1, rad/s.
        eyes: its sensors.
        goal: the body at whose touch it is paid 1, and the episode ends; none if empty.
    """
    rewards: list[RewardFunc] = []
    if goal:
        rewards = [
            TouchRewardFunc(name="arrived", target=goal, reward=1, cause_episode_to_end=True)
        ]
    return BasicAgent(
        body="robot",
        sensors=list(eyes),
        actuators=[RBMoveActuator(move_amount=move, turn_amount=turn)],
        rewards=rewards,
        brains=[brain],
    )


def has_arrived(done: Drive) -> bool:
    """Return True if a robot touched its goal."""
    return is_close(done.agent.ledger.episode_total, 1, 1e-6)


def with_lamp(size: tuple[float, float], **robot: Any) -> World:
    """Return a plate with a lamp in the middle, and a robot."""
    world = World()
    world.add_floor("plate", BoxShape(size=size))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), **robot)
    world.add_body("lamp", CircleShape(radius=0.4), kind="static", tags=("lamp",), colour="yellow")
    return world


def posts_around(distances: list[float]) -> bytes:
    """Return a picture of a robot with posts around it."""
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",))
    for number, away in enumerate(distances):
        angle = math.tau * number / len(distances)
        place = (away * math.cos(angle), away * math.sin(angle))
        colour = "orange" if away < NEAR_M else "grey"
        shape = CircleShape(radius=0.25)
        world.add_body(f"post {number}", shape, kind="static", position=place, colour=colour)
    agent = robot_with(LocalBrain(controller=lambda _: {}), move=1)
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    return picture(capture_snapshot(sim))


def carry_out(words: list[str], ahead: int, left: int) -> Drive:
    """Carry out a plan in a world with a flag."""
    world = World()
    world.add_floor("plate", BoxShape(size=(14, 14)))
    flag = BoxShape(size=(0.8, 0.8))
    world.add_area("flag", flag, position=(ahead, left), colour="green", paint=True)
    world.add_body("robot", CircleShape(radius=0.4), tags=("agent",))
    actions = [WORDS[word] for word in words for _ in range(STEP_DECISIONS)]
    queue = iter(actions)
    brain = LocalBrain(controller=lambda _: {"move": next(queue)})
    metres, quarter = 1.0, math.pi / 2
    a_second = DECISIONS_A_SECOND / STEP_DECISIONS
    agent = robot_with(brain, move=metres * a_second, turn=quarter * a_second)
    return drive(ControlRequestor(world, [agent]), agent, 1, len(actions))


def two_eyed(brain: Brain, seed: int) -> ControlRequestor:
    """Return a world with a robot that sees a lamp in front of it or beside it."""
    chance = np.random.default_rng(seed)
    around, away = chance.uniform(-math.pi, math.pi), chance.uniform(3, 5)
    aside = chance.uniform(20, 90) * chance.choice([-1.0, 1.0])
    world = with_lamp(
        (12, 12),
        position=(away * math.cos(around), away * math.sin(around)),
        heading_deg=math.degrees(around) + 180 + aside,
    )
    eyes = [
        LightSensor(
            perception_key=f"{side} eye", group="lamp", angle_deg=angle, reach=LIGHT_REACH_M
        )
        for side, angle in EYES.items()
    ]
    return ControlRequestor(world, [robot_with(brain, move=2, eyes=eyes, goal="lamp")])
