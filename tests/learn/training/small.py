"""Trainings that take a second: of use to tests, of none to agents."""

import atexit
import shutil
import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from ai4u_edu import Scene
from ai4u_edu.learn.training.learning import train
from ai4u_edu.learn.training.run import Run, Trained
from ai4u_edu.learn.training.settings import Algorithm, Settings, settings_for

SMALL: dict[str, dict[str, Any]] = {
    "sac": {"worlds": 2, "steps": 200, "check_every": 100, "learning_starts": 50, "batch_size": 16},
    "ppo": {"worlds": 2, "steps": 256, "check_every": 100, "n_steps": 32, "batch_size": 32},
    "dqn": {"worlds": 2, "steps": 200, "check_every": 100, "learning_starts": 50, "batch_size": 16},
}

CHOICES = """
name: choices
success: touch
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 1]}
agents:
  - body: robot
    max_steps_per_episode: 30
    sensors:
      - {type: BearingSensor, target: box}
      - {type: LocalGridSensor, width: 36, height: 36, cell_size: 0.25}
      - {type: GroundStatusSensor}
    actuators:
      - {type: DiscreteActuator, action_name: choice, move_amount: 2, turn_amount: 2}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: DiscreteArrowController, actuator_name: choice}}
"""


def small_settings(scene: str = "box_chase", **changes: Any) -> Settings:
    """A scene's settings, with little to do."""
    plain = settings_for(scene).model_dump() | {"check_episodes": 2, "max_steps": 20, "enough": 0}
    for algorithm, few in SMALL.items():
        plain[algorithm] = plain[algorithm] | few
    return Settings.model_validate(plain | changes)


def small_training(
    folder: Path, algorithm: Algorithm = "ppo", *, seed: int = 0, **changes: Any
) -> Trained:
    """A second of learning box_chase."""
    scene = Scene.load("box_chase")
    return train(scene, algorithm, small_settings(**changes), folder, seed=seed, quiet=True)


@cache
def _first_training(algorithm: Algorithm) -> Trained:
    folder = Path(tempfile.mkdtemp(prefix="ai4u-training-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return small_training(folder / "run", algorithm)


def copied_training(folder: Path, algorithm: Algorithm = "ppo") -> Trained:
    """Copy a small training with seed 0, which is run once per process, into a folder."""
    first = _first_training(algorithm)
    shutil.copytree(first.folder, folder, dirs_exist_ok=True)
    return replace(first, run=Run(folder))
