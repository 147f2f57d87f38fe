"""Every field of a scene goes wherever a world is made from one: none is lost on the way."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import BaseModel

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.world_copy import WorldCopy
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription

WORDS = {"name", "title", "level", "minutes", "few_decisions", "controls", "rewards"}
"""Fields about the scene, for people; a world has none of them."""

DOT = (
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABAQAAAAA3bvkkAAAACklEQVR42mNg"
    "AAAAAgAB5Sfe/AAAAABJRU5ErkJggg=="
)
"""A picture of one pixel."""
TEXT = """
name: whole
title: A whole scene
goal: Touch the box.
level: hard
minutes: 7
few_decisions: 40
controls: W and S
rewards: 10 for the box
success: touch
time_scale: 2.0
spread_decisions: true
wait_for_key: false
world: {ticks_per_second: 50, damping: 0.1, gravity: 9.0, fall_threshold: -3.0}
floors:
  - {name: plate, shape: {type: box, size: [20, 20]}, position: [0.5, 0], heading_deg: 1,
     random: {x: [0.4, 0.6]}, curriculum: {x: [0.45, 0.5]},
     tags: [floor, plain], colour: green, label: ground, top: 0.1}
areas:
  - {name: goal, shape: {type: box, size: [2, 2]}, position: [3, 3], heading_deg: 10,
     random: {y: [3, 4]}, curriculum: {y: [3, 3.1]}, tags: [goal], colour: blue, label: here,
     paint: true, picture: "PICTURE"}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}, position: [-3, 0], z: 0.1, heading_deg: 20,
     height: 0.8, random: {heading_deg: [0, 30]}, curriculum: {heading_deg: [5, 6]},
     colour: orange, label: me, tags: [driven], mass: 2, friction: 0.4, elasticity: 0.1,
     velocity: [0.1, 0], angular_velocity_deg: 5, collision_layer: 3, collision_mask: 7}
  - {name: box, shape: {type: box, size: [1, 2]}, kind: kinematic, position: [4, 0]}
generate: {type: maze, width: 5, height: 4, cell: 5, position: [0.5, 0], start: robot, goal: goal,
  loops: 1, difficulty: 0.9, wall: 0.3, wall_height: 0.9}
agents:
  - id: red
    body: robot
    priority: 2
    max_steps_per_episode: 30
    sensors: [{type: BearingSensor, target: box}]
    actuators: [{type: RBMoveActuator}]
    rewards: [{type: TouchRewardFunc, name: touch, target: box, reward: 10}]
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
""".replace("PICTURE", DOT)


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene.loads(TEXT)


def of_the_world(description: SceneDescription) -> dict[str, Any]:
    """Return all fields but those about the scene; agents as they are built."""
    plain = description.model_dump(exclude=WORDS)
    agents = Scene(description).build(brains=lambda _: LocalBrain(controller=stand)).agents
    return plain | {"agents": [str(agent) for agent in agents]}


def stand(_: object) -> dict[str, Any]:
    return {}


def left_at_default(model: BaseModel) -> Iterator[str]:
    """Yield the fields that no part of a description sets, so that a loss would not be seen."""
    fields = type(model).model_fields
    for name, field in fields.items():
        if not field.is_required() and getattr(model, name) == field.default:
            yield f"{type(model).__name__}.{name}"


def test_this_scene_sets_every_field(scene: Scene) -> None:
    found = scene.description
    parts = [found, found.world, found.floors[0], found.areas[0]]
    assert [name for part in parts for name in left_at_default(part)] == []
    first, second = (set(left_at_default(body)) for body in found.bodies)
    assert first & second == set()


def test_a_world_that_is_built(scene: Scene) -> None:
    assert of_the_world(export_scene(scene.build())) == of_the_world(scene.description)


def test_a_file(scene: Scene, tmp_path: Path) -> None:
    scene.save(tmp_path / "scene.yaml")
    assert Scene.load(tmp_path / "scene.yaml").description == scene.description
    assert Scene.loads(Scene(scene.description).dumps()).description == scene.description


def test_a_recording_and_its_replay(scene: Scene, tmp_path: Path) -> None:
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(5)
    for _ in range(10):
        sim.step()
    recorder.finish()
    episode = Episode.load(recorder.episodes[-1].save(tmp_path / "drive.episode"))
    assert of_the_world(episode.scene) == of_the_world(scene.description)
    assert all(getattr(episode.scene, name) == getattr(scene.description, name) for name in WORDS)
    assert of_the_world(export_scene(Player(episode).sim)) == of_the_world(scene.description)
    assert Replay(episode).verdict.exact


def test_an_edited_world(scene: Scene) -> None:
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    changed = editor.add_block("red", "sensors", {"type": "OrientationSensor", "target": "box"})
    runner.advance()
    changed.result(0)
    assert of_the_world(export_scene(runner.sim)) == of_the_world(editor.scene.description)


def test_a_copy_for_explanations(scene: Scene) -> None:
    sim = scene.build()
    sim.reset(5)
    copy = WorldCopy(sim, Policy(stand))
    assert of_the_world(export_scene(copy.sim)) == of_the_world(scene.description)
