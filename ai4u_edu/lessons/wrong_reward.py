"""Training with a well-meant reward that asks for something else than was meant."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ai4u_edu.blocks import LocalBrain
from ai4u_edu.lessons.rollouts import Drive, drive, driven_by
from ai4u_edu.scenes import Scene

SCENE = """
name: wrong_reward
title: Well meant
goal: Touch the box.
success: touch
floors:
  - {name: plate, shape: {type: box, size: [10, 10]}}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
    tags: [agent]
    random: {x: [-3.5, 3.5], y: [-3.5, 3.5], heading_deg: [-180, 180], clearance: 1.0}
  - {name: box, shape: {type: box, size: [1, 1]}, kind: static, tags: [target]}
agents:
  - body: robot
    max_steps_per_episode: 60
    sensors:
      - {type: BearingSensor, target: box}
      - {type: OrientationSensor, target: box, info: distance}
    actuators:
      - {type: RBMoveActuator, move_amount: 3, turn_amount: 3, jump_power: 0, jump_forward_power: 0}
    rewards:
      - {type: DistanceToTargetRewardFunc, target: box, max_reward: 3}
      - {type: TouchRewardFunc, target: box, reward: 10, cause_episode_to_end: true}
      - {type: FallReward, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, skip_frame: 9, controller: {type: WASDRBMoveController}}
"""
LIMIT = 60
"""Decisions of an episode, of a sixth of a second each."""
OUTCOMES = ("touches", "lingers", "falls")


@dataclass(frozen=True)
class Hacker:
    """Policy that learned with the wrong reward."""

    trained: Any
    """Result of the training; None in tests, which have no time to train."""


def learn_wrong_reward(steps: int = 3000, seed: int = 0) -> Hacker:
    """Train SAC with the well-meant reward; takes about 15 s, nothing with ``AI4U_FAST=1``.

    Args:
        steps: decisions to learn from.
        seed: seed of the network, the worlds and all random choices.
    """
    from ai4u_edu.learn.training import train

    if os.environ.get("AI4U_FAST"):
        return Hacker(None)
    trained = train(
        Scene.loads(SCENE, name="wrong_reward"),
        "sac",
        steps=steps,
        seed=seed,
        out=Path("runs") / f"wrong-reward-{steps}-{seed}",
        settings={"sac": {"check_every": 10 * steps}, "check_episodes": 2},
        overwrite=True,
    )
    return Hacker(trained)


def outcomes(hacker: Hacker, seeds: list[int]) -> tuple[dict[str, int], Drive]:
    """Return how often a robot touched, lingered and fell, and the last episode."""
    scene = Scene.loads(SCENE, name="wrong_reward")
    if hacker.trained is None:
        sim = scene.build()
        idle = LocalBrain(controller=lambda _: {"move": [0, 0, 0, 0]}, skip_frame=9)
        sim.agents[0].use_brain(idle)
    else:
        sim = driven_by(hacker.trained, scene)
    agent = sim.agents[0]
    counts = dict.fromkeys(OUTCOMES, 0)
    for seed in seeds:
        done = drive(sim, agent, seed, LIMIT)
        counts["touches" if done.won else "falls" if done.fell else "lingers"] += 1
    return counts, done
