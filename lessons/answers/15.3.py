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
