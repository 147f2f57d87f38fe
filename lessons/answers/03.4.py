# %% tags=["solution"]
def steer(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    rewards=[
        TouchRewardFunc(target="box", reward=10, cause_episode_to_end=True),
        FallReward(cause_episode_to_end=True),
    ],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "mirrored"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "behind"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, -left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["right", "turns first"]
def steer(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.9:
        return {"move": [0, -0.5 if left > 0 else 0.5, 0, 0]}
    return {"move": [1, 0, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["right", "by the angle"]
import math


def steer(percept):
    left, ahead = percept["bearing"]
    angle = math.atan2(left, ahead)
    return {"move": [0 if abs(angle) > 1 else 1, max(-1, min(1, -angle)), 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["right", "backward"]
def steer(percept):
    left, ahead = percept["bearing"]
    if ahead > 0:
        return {"move": [0, 1 if left > 0 else -1, 0, 0]}
    return {"move": [-1, left, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "stays", "turns for ever"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [0, -1 if left > 0 else 1, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "sideways", "turns by the cosine"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, -ahead, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["wrong", "look", "straight on"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, 0, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["lucky", "circles"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [0.6, 0.4, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["lucky", "by chance"]
import random


def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [random.uniform(0, 1), random.uniform(-1, 1), 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)


# %% tags=["lucky", "drives when it is near the line"]
def steer(percept):
    left, ahead = percept["bearing"]
    return {"move": [1 if abs(left) < 0.05 else 0, 1, 0, 0]}


finder = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
    brains=[LocalBrain(controller=steer)],
)
