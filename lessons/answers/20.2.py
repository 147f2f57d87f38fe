# %% tags=["solution"]
def solve(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


played_scene = """
name: solved
title: Solved
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, 4], y: [-4, 4], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [-4, 4], y: [-4, 4]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


# %% tags=["wrong", "never"]
def solve(percept):
    left, ahead = percept["bearing"]
    return {"move": [1, left, 0, 0]}


played_scene = """
name: solved
title: Solved
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, 4], y: [-4, 4], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [-4, 4], y: [-4, 4]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


# %% tags=["right", "another world"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [9, 9]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["right", "turns first"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    left, ahead = percept["bearing"]
    if ahead < 0.97:
        return {"move": [0, -0.4 if left > 0 else 0.4, 0, 0]}
    return {"move": [1, 0, 0, 0]}


# %% tags=["wrong", "begin", "does nothing"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    return {"move": [0, 0, 0, 0]}


# %% tags=["wrong", "idle", "paid for nothing"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: rest
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    position: [-3, 0]
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 0]
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: RestlessnessRewardFunc, name: rest, reward: 1, min_dist: 5}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    return {}


# %% tags=["wrong", "unfinished", "no scene"]
played_scene = ""


def solve(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "no-return", "returns nothing"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    left, ahead = percept["bearing"]


# %% tags=["lucky", "straight on"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    return {"move": [1, 0, 0, 0]}


# %% tags=["lucky", "circles"]
played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    return {"move": [1, 0.3, 0, 0]}


# %% tags=["lucky", "by chance"]
import random

played_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solve(percept):
    return {"move": [random.uniform(-1, 1), random.uniform(-1, 1), 0, 0]}
