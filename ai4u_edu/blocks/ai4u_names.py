"""Counterparts of those classes of AI4U that no block here names as its source.

A block whose docstring says ``Source: AI4U's NAME`` is the counterpart of that name already.
"""

from typing import NamedTuple


class Counterpart(NamedTuple):
    """A class of AI4U and its counterpart here."""

    ai4u: str
    here: str
    """Name that ``ai4u_edu`` exports; empty if there is none."""
    words: str


CLASSES = (
    Counterpart("Actuator", "Actuator", "The base of all actuators."),
    Counterpart(
        "AgentRewardFunc",
        "BasicAgent",
        "No block: ``agent.add_reward(amount, request_done)``, from any event's handler.",
    ),
    Counterpart(
        "ArrowPhysicsMoveController2D",
        "ArrowController",
        "One controller for all bodies; ``components`` and the lists of keys adapt it.",
    ),
    Counterpart("BasicAgent", "BasicAgent", "A body with sensors, actuators, rewards and a brain."),
    Counterpart("Brain", "Brain", "The base of all brains."),
    Counterpart(
        "Camera",
        "LocalGridSensor",
        "There is no camera, but an image from above, for image policies.",
    ),
    Counterpart("Camera3DSensor", "LocalGridSensor", "Like Camera; grayScale doesn't exist here."),
    Counterpart(
        "CBMoveActuator2D",
        "CBMoveActuator",
        "The world is seen from above: flipWhenTurn and lerpFactor don't exist here.",
    ),
    Counterpart(
        "CBRespawnActuator",
        "RespawnActuator",
        "radomizeDirection is ``randomise_heading``, and off by default.",
    ),
    Counterpart(
        "CBRespawnActuator2D", "RespawnActuator", "flipWhenTurn and randomize don't exist here."
    ),
    Counterpart("Controller", "Controller", "The base of all controllers of a LocalBrain."),
    Counterpart(
        "ControlRequestor",
        "ControlRequestor",
        "The decision cycle of a world and its agents: ``ControlRequestor(world, [agent])``.",
    ),
    Counterpart(
        "LinearRayCastingSensor2D",
        "LinearRayCastingSensor",
        "groupCode and groupName are one table, ``group_code``; shift is ``horizontal_shift``.",
    ),
    Counterpart("LocalBrain", "LocalBrain", "A brain in this process, which asks its controller."),
    Counterpart("MinDistReward2D", "MinDistReward", "One block for both."),
    Counterpart("RaycastMapping", "", "No class: a ray sensor's ``group_code`` is a dictionary."),
    Counterpart(
        "RBMoveActuator2D", "RBMoveActuator", "One block for both; here it moves the body."
    ),
    Counterpart(
        "RestlessnessRewardFunc",
        "RestlessnessRewardFunc",
        "The 3D version, with increseRate and decreaseRate, punishes moving: ours is the 2D one.",
    ),
    Counterpart("RewardFunc", "RewardFunc", "The base of all reward functions."),
    Counterpart(
        "RLAgent",
        "BasicAgent",
        "The later name of BasicAgent; ``done_at_negative_reward`` is off by default, there on.",
    ),
    Counterpart(
        "ScreenSensor",
        "LocalGridSensor",
        "Like Camera. To watch a world, open its page or render it.",
    ),
    Counterpart(
        "Sensor", "Sensor", "The base of all sensors; ``normalized`` is off by default, there on."
    ),
    Counterpart(
        "TouchRewardFunc2D",
        "TouchRewardFunc",
        "One block for both; a target may be an area. The cool-down is 0, there 0.2 s.",
    ),
    Counterpart(
        "Trainer", "Trainer", "A script that gets each percept of a TrainController and directs it."
    ),
    Counterpart(
        "Utils",
        "",
        "No class: percepts and actions are dictionaries with numbers in them.",
    ),
)
