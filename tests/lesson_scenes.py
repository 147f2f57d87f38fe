"""Worlds of lessons as scenes for missions in the page: ``python -m tests.lesson_scenes --write``.

They are made from the lessons' own code, so that a change of a lesson's world reaches its mission.
"""

import argparse
import math
from collections.abc import Callable, Mapping

import numpy as np

from ai4u_edu import (
    Actuator,
    AndRewardFunc,
    BasicAgent,
    BearingSensor,
    Brain,
    ControlRequestor,
    DistanceToTargetRewardFunc,
    FallReward,
    FigureReward,
    LocalBrain,
    OrientationSensor,
    RBMoveActuator,
    RespawnActuator,
    RestlessnessRewardFunc,
    RewardFunc,
    Scene,
    Sensor,
    TouchRewardFunc,
    TouchSensor,
    WASDController,
    WASDRBMoveController,
)
from ai4u_edu.lessons.exercises.lesson_02 import runway
from ai4u_edu.lessons.exercises.lesson_05 import vehicle
from ai4u_edu.lessons.exercises.lesson_06 import stroll_world
from ai4u_edu.lessons.exercises.lesson_07 import WALL_DECISIONS, robot_with, wall_world
from ai4u_edu.lessons.exercises.lesson_08 import feeler_runway
from ai4u_edu.lessons.exercises.lesson_18 import creature
from ai4u_edu.lessons.exercises.lesson_21 import road
from ai4u_edu.lessons.rollouts import seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.page.editing.scene_pictures import TEMPLATES
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import SceneDescription

KEYS = LocalBrain(controller=WASDRBMoveController(jump=[], jump_forward=[]))
WHEELS = LocalBrain(
    controller=WASDController(
        actuator_name="wheels", speed=0.5, turn_amount=0.3, jump=[], jump_forward=[]
    )
)
PEN = LocalBrain(
    controller=WASDController(
        speed=0.5, turn_amount=0.5, jump=[], jump_forward=[], switches={"pen": ["Space"]}
    )
)
HIT, INKED, ARRIVED = "hit", "inked", "arrived"
FALL_ENDS = FallReward(cause_episode_to_end=True)
CONTROLS = "W forward, S backward, A left, D right, R restart"
TOUCH = TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True)


def robot_on_plate(
    motor: Actuator, sensors: list[Sensor] | None = None, rewards: list[RewardFunc] | None = None
) -> ControlRequestor:
    """Return the world of the lessons 03, 04 and 09, with a robot to build on."""
    agent = BasicAgent(
        body="robot", sensors=sensors or [], actuators=[motor], rewards=rewards or [], brains=[KEYS]
    )
    return ControlRequestor(plate(), [agent])


def lamp_world(exercise: str) -> ControlRequestor:
    """Return the world of lesson 05, whose starts are those in which its exercise is checked."""
    worlds = [vehicle(lambda _: {}, seed) for seed in seeds_of(exercise, 12)]
    poses = []
    for sim in worlds:
        body = sim.world["vehicle"]
        heading = round(math.degrees(body.heading), 3)
        poses.append((*np.round(body.position, 3).tolist(), heading))
    rewards = [TouchRewardFunc(name=HIT, target="lamp", reward=10, cause_episode_to_end=True)]
    agent = worlds[0].agents[0]
    changed = agent.changed(
        actuators=[*agent.actuators, RespawnActuator(poses=poses)],
        rewards=[*rewards, FALL_ENDS],
        brains=[WHEELS],
    )
    return ControlRequestor(worlds[0].world, [changed])


def striped_road() -> ControlRequestor:
    """Return the world of 21.1, which is won at the end of the road if orange and ink agree."""
    sim = road(lambda _: {}, seed=3)
    agent = sim.agents[0]
    parts = [
        TouchRewardFunc(name="there", target="end"),
        FigureReward(group="orange", at_least=0.6),
    ]
    won = AndRewardFunc(name=INKED, reward=10, cause_episode_to_end=True, children=parts)
    changed = agent.changed(rewards=[won, *agent.rewards], brains=[PEN])
    return ControlRequestor(sim.world, [changed])


def plate_with_an_edge() -> ControlRequestor:
    """Return the world of 06.1, in which a fall ends an episode, as it ends the exercise."""
    sim = stroll_world()
    return ControlRequestor(sim.world, [sim.agents[0].changed(brains=[KEYS], rewards=[FALL_ENDS])])


def behind_a_wall() -> ControlRequestor:
    """Return a world of 07.1, with a wall that has an arm."""
    arrived = TouchRewardFunc(name=ARRIVED, target="box", reward=1, cause_episode_to_end=True)
    senses = [TouchSensor(target="wall", perception_key="bumper"), BearingSensor(target="box")]
    agent = robot_with(KEYS, senses, arrived).changed(
        rewards=[arrived, FALL_ENDS], max_steps_per_episode=WALL_DECISIONS
    )
    return ControlRequestor(wall_world(1, has_arm=True), [agent])


def driven_by_keys(sim: ControlRequestor, brain: Brain = KEYS) -> ControlRequestor:
    """Return a lesson's world whose robot has keys in place of a student's function."""
    return ControlRequestor(sim.world, [sim.agents[0].changed(brains=[brain])])


MOTOR = RBMoveActuator(move_amount=2, turn_amount=3)
WORLDS: Mapping[str, tuple[str, str, Callable[[], ControlRequestor]]] = {
    "lesson_02": (
        "Stop before the box",
        "Drive towards the box, and stop 2 metres from its centre.",
        lambda: driven_by_keys(runway()),
    ),
    "lesson_03_legs": (
        "A robot with legs",
        "Give the robot its legs.",
        lambda: robot_on_plate(RBMoveActuator()),
    ),
    "lesson_03": (
        "A robot to build",
        "Build a robot that finds the box.",
        lambda: robot_on_plate(MOTOR),
    ),
    "lesson_04": (
        "A robot to give senses",
        "Choose what the robot senses.",
        lambda: robot_on_plate(MOTOR, [OrientationSensor(target="box")]),
    ),
    "lesson_05": (
        "The lamp",
        "Hit the lamp.",
        lambda: lamp_world("05.1"),
    ),
    "lesson_06": (
        "A plate with an edge",
        "Stroll about for 30 seconds, and do not fall.",
        plate_with_an_edge,
    ),
    "lesson_07": (
        "A wall in the way",
        "Get to the box behind the wall.",
        behind_a_wall,
    ),
    "lesson_08": (
        "A runway",
        "Drive to the end, and do not fall.",
        lambda: driven_by_keys(feeler_runway(lambda _: {}, 4)),
    ),
    "lesson_09": (
        "What pays?",
        "Choose what the robot is paid for.",
        lambda: robot_on_plate(
            MOTOR, rewards=[DistanceToTargetRewardFunc(target="box", max_reward=1), TOUCH]
        ),
    ),
    "lesson_09_quick": (
        "What does time cost?",
        "Choose what a fall and a decision cost.",
        lambda: robot_on_plate(
            MOTOR,
            rewards=[
                TOUCH,
                FallReward(success_reward=-1, cause_episode_to_end=True),
                RestlessnessRewardFunc(reward=0, min_dist=5),
            ],
        ),
    ),
    "lesson_18": (
        "A creature with needs",
        "Stay alive for a minute.",
        lambda: driven_by_keys(creature(lambda _: {})),
    ),
    "lesson_21": (
        "A striped road",
        "Drive to the end, and ink the orange stripes.",
        striped_road,
    ),
}
"""Title, goal and world of each scene, by its name."""


def lesson_scene(name: str) -> Scene:
    """Return a lesson's world as a scene."""
    title, goal, make = WORLDS[name]
    sim = make()
    # where rewards are to be chosen, the page finds the goal among those that are
    success = {"lesson_05": HIT, "lesson_07": ARRIVED, "lesson_21": INKED}.get(name)
    like = SceneDescription(
        name=name, title=title, goal=goal, controls=CONTROLS, success=success, agents=({},)
    )
    return Scene(export_scene(sim, like))


def main() -> None:
    """Write all scenes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", required=True)
    parser.parse_args()
    for name in WORLDS:
        lesson_scene(name).save(TEMPLATES / f"{name}.yaml")


if __name__ == "__main__":
    main()
