"""Q-learning: the textbook's numbers, and a small grid world that is learned and then driven."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.spaces import Box, Discrete

from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training import QTable, evaluate, grid_state, q_learning, still

DIRT = "shape: {type: circle, radius: 0.3}, kind: static, height: 0.1, tags: [dirty]"
WALL = "kind: static, tags: [wall]"
ROOM = """
name: room
success: all_clean
floors:
  - {name: floor, shape: {type: box, size: [7, 7]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}, random: {places: STARTS}}
  - {name: dirt 1, position: [-2, -2], DIRT}
  - {name: dirt 2, position: [2, 2], DIRT}
  - {name: wall 1, shape: {type: box, size: [4, 1]}, position: [-0.5, 0], WALL}
  - {name: wall 2, shape: {type: box, size: [1, 2]}, position: [1, 1.5], WALL}
agents:
  - body: robot
    max_steps_per_episode: 60
    sensors:
      - {type: GridSensor, rows: 7, columns: 7}
      - {type: CellSensor, rows: 7, columns: 7}
    actuators:
      - {type: GridMoveActuator, rows: 7, columns: 7}
      - {type: CollectActuator, action_name: clean, group: dirty}
    rewards:
      - {type: GoneReward, name: cleaned, group: dirty}
      - type: GoneReward
        name: all_clean
        group: dirty
        only_last: true
        reward: 10
        cause_episode_to_end: true
      - {type: RestlessnessRewardFunc, name: step, min_dist: 100, reward: -0.05}
    brains: [{type: LocalBrain, skip_frame: 1, controller: {type: DiscreteArrowController}}]
"""

LEARNT = [[-3, -3], [-3, 3], [0, -2], [3, -3], [3, 0], [0, 3], [3, 3], [-2, 1], [1, -3], [-3, 0]]
UNSEEN = [[-3, -2], [-1, -3], [2, -1], [3, 1], [-3, 2], [-1, 2], [0, -3], [3, -2], [2, 3], [-1, 3]]


def room(starts: list[list[int]]) -> Scene:
    return Scene.loads(
        ROOM.replace("STARTS", str(starts)).replace("DIRT", DIRT).replace("WALL", WALL)
    )


@pytest.fixture(scope="module")
def table() -> QTable:
    env = SceneEnv(room(LEARNT))
    return q_learning(env, episodes=250, curiosity=0.2, quiet=True)


def test_it_cleans_from_where_it_never_began(table: QTable) -> None:
    told = evaluate(table.drive, room(UNSEEN), episodes=20, quiet=True)
    assert told.success_rate == 1.0
    # hardly longer than the way that a search finds on the map
    best = evaluate("BreadthFirstController", room(UNSEEN), episodes=20, quiet=True)
    assert np.mean(told.lengths) < np.mean(best.lengths) + 3


def test_it_got_better_as_it_learned(table: QTable) -> None:
    assert len(table.returns) == 250
    assert np.mean(table.returns[-50:]) > np.mean(table.returns[:50]) + 3


def test_the_same_seed_gives_the_same_table() -> None:
    env = SceneEnv(room(LEARNT))
    one, two, other = (
        q_learning(env, episodes=20, seed=seed, quiet=True).returns for seed in (1, 1, 2)
    )
    assert one == two
    assert one != other


def test_what_is_dirty_is_in_the_state() -> None:
    grid = np.ones((3, 3), np.int32)
    grid[0, 2] = grid[2, 1] = 200
    assert grid_state({"cell": np.array([1, 0]), "grid": grid}) == (1, 0, 2, 7)
    grid[0, 2] = 1
    assert grid_state({"cell": np.array([1, 0]), "grid": grid}) == (1, 0, 7)


class Corridor(gymnasium.Env[int, int]):
    """Two steps to the right pay 1; to the left ends it at once for nothing."""

    observation_space: Any = Discrete(3)
    action_space: Any = Discrete(2)

    def reset(self, **_: Any) -> tuple[int, dict[str, Any]]:
        self.at = 0
        return 0, {}

    def step(self, action: int) -> tuple[int, float, bool, bool, dict[str, Any]]:
        if action == 0:
            return self.at, 0.0, True, False, {}
        self.at += 1
        return self.at, float(self.at == 2), self.at == 2, False, {}


def test_the_numbers_of_the_textbook() -> None:
    table = q_learning(
        Corridor(),
        state=lambda seen: seen,
        episodes=200,
        rate=1.0,
        discount=0.5,
        curiosity=1.0,
        quiet=True,
    )
    assert table.of(1).tolist() == [0.0, 1.0]
    assert table.of(0).tolist() == [0.0, 0.5]
    assert table.best(0) == 1
    half = q_learning(
        Corridor(), state=lambda seen: seen, episodes=200, rate=0.5, curiosity=1.0, quiet=True
    )
    assert half.of(1)[1] == pytest.approx(1.0, abs=1e-6)
    assert half.of(0)[1] == pytest.approx(0.99, abs=1e-6)


def test_it_needs_actions_to_choose_from() -> None:
    class Wide(Corridor):
        action_space = Box(0, 1)

    with pytest.raises(SetupError, match="actions to choose from"):
        q_learning(Wide(), quiet=True)


def test_a_scene_that_stays_as_it_is() -> None:
    scene = Scene.load("grid_world")
    sim = still(scene, "robot").build()
    places = []
    for seed in range(6):
        sim.reset(seed)
        places.append({name: body.position for name, body in sim.world.bodies.items()})
    robots = {each.pop("robot") for each in places}
    assert len(robots) > 1
    assert all(each == places[0] for each in places)
    assert any(thing.random for thing in scene.description.things if thing.name != "robot")
    with pytest.raises(SetupError, match="nothing called 'robt'; did you mean 'robot'"):
        still(scene, "robt")
