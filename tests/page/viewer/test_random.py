"""The page draws randomized scenes as they are in each episode."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks import LocalGridSensor
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.runtime.runner import Runner
from tests.page.viewer.pages import publish

SCENE = """
name: varied
areas:
  - {name: goal, shape: {type: circle, radius: 0.5}, random: {x: [5, 9], y: [5, 9]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}}
  - name: box
    shape: {type: box, size: [1, 2]}
    tags: [target]
    random: {x: [-4, 4], y: [-4, 4], heading_deg: [-180, 180], scale: [0.5, 1.5]}
agents:
  - body: robot
    sensors: [{type: LocalGridSensor, channels: [target], width: 48, height: 48, cell_size: 0.25}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


@pytest.fixture
def runner() -> Runner:
    return Runner(Scene.loads(SCENE).build(), seed=1)


@pytest.fixture
def episodes(runner: Runner, viewer: Viewer) -> "Iterator[Shown]":
    def each() -> "Iterator[Shown]":
        for seed in range(1, 6):
            runner.sim.reset(seed)
            publish(runner)
            viewer.draw(runner.latest)
            yield Shown(viewer, runner)

    return each()


class Shown:
    """The scene nodes of the box and the area on the page."""

    def __init__(self, viewer: Viewer, runner: Runner) -> None:
        scene = viewer.server.scene
        names = sorted(scene._handle_from_node_name)
        # bodies of one kind share a batch: the robot is the first, the box the second
        box: Any = scene.get_handle_by_name(next(n for n in names if n.endswith("/1/body")))
        fill: Any = scene.get_handle_by_name(next(n for n in names if n.endswith("goal/fill")))
        self.place = tuple(box.batched_positions[0, :2].tolist())
        self.turn = tuple(box.batched_wxyzs[0].tolist())
        corners = box.vertices[:, :2]
        self.size = tuple((corners.max(axis=0) - corners.min(axis=0)).tolist())
        self.goal = tuple(fill.vertices[:, :2].mean(axis=0).tolist())
        self.runner = runner


def test_place_heading_and_size_are_those_of_the_episode(episodes: Iterator[Shown]) -> None:
    seen = []
    for shown in episodes:
        world = shown.runner.sim.world
        box, goal = world["box"], world.areas["goal"]
        scale = box.sampled.shape.reach / box.description.shape.reach
        assert shown.place == pytest.approx(box.position, abs=1e-5)
        assert shown.size == pytest.approx((scale, 2 * scale), abs=1e-5)
        assert abs(shown.turn[0]) == pytest.approx(abs(np.cos(box.heading / 2)), abs=1e-5)
        assert shown.goal == pytest.approx((goal.x, goal.y), abs=0.2)
        assert shown.runner.latest.static_scene.bodies[1].shape == box.sampled.shape
        seen.append((shown.place, shown.turn, shown.size, shown.goal))
    assert [len(set(each)) for each in zip(*seen, strict=True)] == [5, 5, 5, 5]


def test_the_grid_around_the_robot_shows_the_same(episodes: Iterator[Shown]) -> None:
    for shown in episodes:
        (agent,) = shown.runner.sim.agents
        (grid,) = (each for each in agent.sensors if isinstance(each, LocalGridSensor))
        cells = agent.percept[grid.perception_key][..., 0] > 0
        covered = cells.sum() * 0.25**2
        width, length = shown.size
        assert covered == pytest.approx(width * length, rel=0.35)
