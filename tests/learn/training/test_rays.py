"""Codes are names: a network is told how close each kind of thing is, ray by ray."""

from pathlib import Path

import numpy as np
import pytest
import torch
from gymnasium.spaces import Box

from ai4u_edu import LinearRayCastingSensor, RayCastingSensor, Scene
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of
from ai4u_edu.learn.training import dagger
from ai4u_edu.learn.training.cloning import Clone, write_network
from ai4u_edu.learn.training.rays import CLOSE, RayNearness, rays_of
from ai4u_edu.learn.training.settings import DaggerSettings
from tests.scenes.solvers import solver_of

pytestmark = pytest.mark.needs("train")

NAMED = {"food": 2, "wall": 4}


@pytest.mark.parametrize(
    ("normalized", "normalize_distance", "codes", "distances"),
    [(True, True, [0, 0.5, 1], [0, 0.5, 1]), (False, False, [0, 2, 4], [0, 5, 10])],
)
def test_each_kind_of_each_ray_has_a_place_of_its_own(
    normalized: bool, normalize_distance: bool, codes: list[float], distances: list[float]
) -> None:
    """It met nothing, food half way, and a wall at the end; one other reading stands before."""
    sensor = LinearRayCastingSensor(
        perception_key="eye",
        number_of_rays=3,
        group_code=NAMED,
        vision_max_distance=10,
        return_distance=True,
        normalized=normalized,
        normalize_distance=normalize_distance,
    )
    rays = RayNearness(sensor, 1)
    seen = np.array([[9, *np.column_stack([codes, distances]).ravel()]], np.float32)
    wanted: list[list[float]] = [[0, 0], [1 - CLOSE / 2, 0], [0, 1 - CLOSE]]
    assert rays(torch.from_numpy(seen)).tolist() == [np.ravel(wanted).tolist()]


def test_a_grid_of_rays_has_first_its_codes_and_then_its_distances() -> None:
    sensor = RayCastingSensor(
        perception_key="eye", rows=1, columns=2, group_code=NAMED, return_distance=True
    )
    seen = torch.tensor([[0.5, 1.0, 0.2, 0.4]])
    told = RayNearness(sensor, 0)(seen)[0].tolist()
    assert told == pytest.approx([1 - 0.2 * CLOSE, 0, 0, 1 - 0.4 * CLOSE])


def test_those_of_an_agent_see_what_it_sees() -> None:
    sim = Scene.load("platform").build()
    agent = sim.agents[0]
    sim.reset(3)
    fruit = sim.world["fruit"].position
    agent.body.move_to(fruit[0] - 2.0, fruit[1], heading=0.0)
    sim.step()
    around, vision = rays_of(agent)
    seen = Observer(agent, "flat").observe(agent.percept)
    codes, distances = agent.percept["around"].reshape(-1, 2).T
    told = around(torch.from_numpy(seen)[None])[0].reshape(-1, 3)
    assert (told.sum(axis=1) > 0).tolist() == (codes > 0).tolist()
    assert told.max() == pytest.approx(1 - CLOSE * distances[codes > 0].min())
    floor = agent.percept["vision"][0].ravel() == 0.25
    assert floor.any()
    assert (vision(torch.from_numpy(seen)[None])[0].reshape(-1, 4)[:, 0] > 0).tolist() == (
        floor.tolist()
    )


def test_a_network_sees_through_them_alone() -> None:
    """The bare codes and distances have no other way in; what else there is to read has."""
    rays = rays_of(Scene.load("forage").build().agents[0])
    seen = np.random.default_rng(0).random((20, 99), np.float32)
    network = Clone(seen, Box(-1.0, 1.0, (4,)), rays=rays)
    assert network.places.tolist() == [94, 95, 96, 97, 98]
    assert network.layers[0].in_features == 5 + 47 * 3


def test_what_is_written_does_the_same(tmp_path: Path) -> None:
    sim = Scene.load("forage").build()
    agent = sim.agents[0]
    observer = Observer(agent, "flat")
    sim.reset(0)
    seen = []
    for _ in range(30):
        sim.step()
        seen.append(observer.observe(agent.percept))
    network = Clone(np.stack(seen), action_space_of(agent), (16,), rays=rays_of(agent))
    file = tmp_path / "a.onnx"
    write_network(network, agent, {"skip_frame": 4, "repeat_action": True}, file)
    done = network(torch.from_numpy(observer.observe(agent.percept))[None])[0].tolist()
    assert Network(file).decide(agent.percept)["move"].tolist() == pytest.approx(done, abs=1e-5)


@pytest.mark.parametrize(("kinds", "inputs"), [(True, 47 * 3), (False, 47 * 2)])
def test_a_teachers_settings_ask_for_them(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, kinds: bool, inputs: int
) -> None:
    pupils: list[Clone] = []
    monkeypatch.setattr(dagger, "write_network", lambda pupil, *_: pupils.append(pupil))
    how = DaggerSettings(rounds=1, episodes=1, updates=1, kinds=kinds)
    scene = Scene.load("forage")
    dagger.imitate(lambda: solver_of("forage"), scene, tmp_path / "a.onnx", how, quiet=True)
    assert inputs - 5 <= pupils[0].layers[0].in_features <= inputs + 5


@pytest.mark.parametrize(
    "instead",
    [
        "return_distance: false",
        "return_distance: true\n        return_code: false",
        "return_distance: true\n        stacked_observations: 2",
    ],
)
def test_a_sensor_that_does_not_tell_both_is_read_as_it_is(instead: str) -> None:
    text = Scene.load("forage").dumps()
    assert "return_distance: true" in text
    assert not rays_of(
        Scene.loads(text.replace("return_distance: true", instead)).build().agents[0]
    )
