# %% tags=["solution"]
hard_scene = """
name: just_right
title: Just right
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [14, 14]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-5, -4], y: [-4, 4], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [4, 5], y: [-4, 4]}
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 300
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "easy"]
hard_scene = """
name: too_easy
title: Too easy
goal: Touch the box.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box
success: touch
floors:
  - name: plate
    shape: {type: box, size: [7, 7]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [1.2, 0]
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards: [{type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["right", "a larger plate"]
hard_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [16, 16]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-6, -5], y: [-5, 5], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [5, 6], y: [-5, 5]}
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


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["right", "little time"]
hard_scene = """
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
    max_steps_per_episode: 60
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "easy", "a small plate"]
hard_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: touch
floors:
  - name: plate
    shape: {type: box, size: [7, 7]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    position: [-1, 0]
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [1.2, 0]
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


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "impossible", "a wall across the plate"]
hard_scene = """
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
  - {name: cage, shape: {type: box, size: [0.4, 12]}, kind: static, position: [0, 0]}
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


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "impossible", "one decision"]
hard_scene = """
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
    max_steps_per_episode: 1
    sensors: [{type: BearingSensor, target: box}, {type: TouchSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["wrong", "impossible", "no solver"]
hard_scene = """
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


def solver(percept):
    return {}


# %% tags=["lucky", "the name of a scene"]
hard_scene = "maze"


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["lucky", "nothing"]
hard_scene = ""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


# %% tags=["lucky", "at the box"]
hard_scene = """
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
    position: [2.02, 0]
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
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def solver(percept):
    left, ahead = percept["bearing"]
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}
