# %% tags=["solution"]
my_scene = """
name: my_world
title: Behind the wall
goal: Get to the box behind the wall. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: arrived
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
    colour: blue
  - name: wall
    shape: {type: box, size: [0.4, 3]}
    kind: static
    tags: [wall]
  - name: box
    shape: {type: box, size: [1, 1]}
    random: {x: [3, 4], y: [-3, 3]}
    tags: [target]
    colour: orange
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors:
      - {type: BearingSensor, target: box}
      - {type: TouchSensor, target: wall, perception_key: bumper}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards:
      - {type: TouchRewardFunc, name: arrived, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""

# %% tags=["wrong", "yaml"]
my_scene = """
name: my_world
title: My world
  goal: Get to the box.
floors:
  - name: plate
"""

# %% tags=["wrong", "success"]
my_scene = """
name: my_world
title: My world
goal: Get to the box.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box
floors:
  - name: plate
    shape: {type: box, size: [10, 10]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-4, -3], y: [-3, 3], heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors:
      - {type: BearingSensor, target: box}
      - {type: TouchSensor, target: box}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""

# %% tags=["wrong", "random"]
my_scene = """
name: my_world
title: My world
goal: Get to the box.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box
success: touch
floors:
  - name: plate
    shape: {type: box, size: [10, 10]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
    tags: [target]
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors:
      - {type: BearingSensor, target: box}
      - {type: TouchSensor, target: box, perception_key: bumper}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""


# %% tags=["right", "the robot looks anywhere"]
my_scene = """
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
    random: {heading_deg: [-180, 180]}
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
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


# %% tags=["right", "the box anywhere"]
my_scene = """
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
    position: [-3, 0]
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


# %% tags=["wrong", "complete", "no goal"]
my_scene = """
name: mine
title: Mine
goal: Go
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


# %% tags=["wrong", "complete", "one sensor"]
my_scene = """
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
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3}]
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


# %% tags=["wrong", "yaml", "a term that there is not"]
my_scene = """
name: mine
title: Mine
goal: Touch the box. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: arrived
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


# %% tags=["wrong", "yaml", "text that is no scene"]
my_scene = "a box and a robot"


# %% tags=["lucky", "only a decoration is random"]
my_scene = """
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
    position: [-3, 0]
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
    tags: [target]
  - name: flower
    shape: {type: circle, radius: 0.2}
    random: {x: [-4, 4], y: [4, 5]}
    kind: static
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


# %% tags=["lucky", "nothing is random"]
my_scene = """
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
    position: [-3, 0]
    tags: [agent]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 1]
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


# %% tags=["lucky", "the name of a scene"]
my_scene = "box_chase"


# %% tags=["wrong", "random", "a place that hardly differs"]
my_scene = """
name: my_world
title: Behind the wall
goal: Get to the box behind the wall. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: arrived
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    random: {x: [-3, -2.9999]}
    tags: [agent]
    colour: blue
  - name: wall
    shape: {type: box, size: [0.4, 3]}
    kind: static
    tags: [wall]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 0]
    tags: [target]
    colour: orange
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors:
      - {type: BearingSensor, target: box}
      - {type: TouchSensor, target: wall, perception_key: bumper}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards:
      - {type: TouchRewardFunc, name: arrived, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""


# %% tags=["right", "another heading each time"]
my_scene = """
name: my_world
title: Behind the wall
goal: Get to the box behind the wall. Do not fall off the plate.
controls: W forward, S backward, A left, D right, R restart
rewards: +10 for touching the box (the end), -1 for falling (the end)
success: arrived
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    position: [-3, 0]
    random: {heading_deg: [-30, 30]}
    tags: [agent]
    colour: blue
  - name: wall
    shape: {type: box, size: [0.4, 3]}
    kind: static
    tags: [wall]
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [3, 0]
    tags: [target]
    colour: orange
agents:
  - body: robot
    max_steps_per_episode: 400
    sensors:
      - {type: BearingSensor, target: box}
      - {type: TouchSensor, target: wall, perception_key: bumper}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3}
    rewards:
      - {type: TouchRewardFunc, name: arrived, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""
