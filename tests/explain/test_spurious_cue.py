"""A network that learned a cue which only happens to be there is caught."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.explain import groups_of_agent, mean_of, occlusion, percepts_of, sentence
from ai4u_edu.explain.sentence import axes_of_agent
from ai4u_edu.learn.training.cloning import clone
from ai4u_edu.recording import Recorder

pytestmark = pytest.mark.needs("train")

LAMP_BESIDE_BOX = """
name: lamp
floors: [{name: plate, shape: {type: box, size: [12, 12]}}]
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}, random: {x: [-5, 1], y: [-5, 5],
      heading_deg: [-180, 180]}}
  - {name: box, shape: {type: box, size: [0.8, 0.8]}, position: [4, 0.8], tags: [target]}
  - {name: lamp, shape: {type: circle, radius: 0.2}, position: [4.8, 0.8], tags: [lamp]}
agents:
  - body: robot
    max_steps_per_episode: 40
    sensors:
      - {type: BearingSensor, target: box, noise: 0.4}
      - {type: BearingSensor, target: lamp, perception_key: lamp}
      - {type: BearingSensor, target: box, perception_key: truth, is_input: false}
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3, jump_power: 0}]
    rewards: [{type: TouchRewardFunc, target: box, reward: 1, cause_episode_to_end: true}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""
LAMP_ELSEWHERE = LAMP_BESIDE_BOX.replace("position: [4.8, 0.8]", "position: [0, -5.5]")


def to_the_box(percept: Any) -> Any:
    sine, cosine = percept["truth"]
    return {"move": [max(0.0, cosine), -sine if cosine > 0 else 1.0, 0, 0]}


def touches(path: Path, text: str, seeds: range) -> int:
    from ai4u_edu.learn.training.evaluating import evaluate
    from ai4u_edu.learn.training.policies import entrant

    found = evaluate(entrant(str(path)), Scene.loads(text), seeds)
    return sum(episode.reward > 0 for episode in found.episodes)


@pytest.mark.nightly  # trains a network
def test_a_lamp_that_always_stands_beside_the_box(tmp_path: Path) -> None:
    scene = Scene.loads(LAMP_BESIDE_BOX)
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    agent = sim.agents[0]
    agent.use_brain(LocalBrain(controller=to_the_box))
    for seed in range(25):
        sim.reset(seed)
        while not agent.done:
            sim.step()
    recorder.finish()
    episodes = list(recorder.episodes)
    path = tmp_path / "clone.onnx"
    clone(episodes, path, quiet=True)
    # where the lamp stands beside the box, nobody would notice
    assert touches(path, LAMP_BESIDE_BOX, range(100, 120)) >= 15
    # its reasons tell: over what it saw, the lamp matters more than the box
    seen = percepts_of(episodes[3])
    told = [occlusion(path, each, baseline=mean_of(seen), groups="sensor") for each in seen]
    box, lamp = np.mean([each.importance for each in told], axis=0)
    assert told[0].names == ("bearing", "lamp")
    assert lamp > 2 * box
    # so it follows the lamp away from the box
    assert touches(path, LAMP_ELSEWHERE, range(100, 120)) <= 9
    other = Scene.loads(LAMP_ELSEWHERE).build()
    other.reset(100)
    agent = other.agents[0]
    why = occlusion(path, agent.percept, baseline=mean_of(seen), groups=groups_of_agent(agent))
    assert "lamp" in sentence(why, axes_of_agent(agent, ["move"]))
