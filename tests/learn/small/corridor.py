"""A corridor that is learned in seconds."""

from ai4u_edu import Scene
from ai4u_edu.learn.small.ppo import PpoSettings

FEW = PpoSettings(worlds=2, steps=16, batch=16, epochs=2, check_every=64, check_episodes=2)
"""Settings of a training that is over at once."""

CORRIDOR = """
name: corridor
success: touch
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 0]}
agents:
  - body: robot
    max_steps_per_episode: 12
    sensors:
      - {type: BearingSensor, target: box}
      - {type: StepSensor}
    actuators:
      - ACTUATOR
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1, cause_episode_to_end: true}
      - {type: MinDistReward, target: box}
    brains:
      - {type: LocalBrain, skip_frame: 9, controller: CONTROLLER}
"""
MOVE = "{type: RBMoveActuator, move_amount: 5, turn_amount: 5}"
CHOOSE = "{type: DiscreteActuator, action_name: choice, move_amount: 5, turn_amount: 5}"


def corridor(*, chooses: bool = False) -> Scene:
    text = CORRIDOR.replace("ACTUATOR", CHOOSE if chooses else MOVE)
    arrows = "{type: DiscreteArrowController, actuator_name: choice}"
    return Scene.loads(text.replace("CONTROLLER", arrows if chooses else "{type: WASDController}"))
