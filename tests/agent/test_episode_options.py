"""Options of a reset change numbers of a scene for one episode, exactly as a scene with them."""

from typing import Any

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, NameNotFoundError, ParameterError, SetupError
from ai4u_edu.learn.training.varying import NumberParameter, number_parameters, with_value
from ai4u_edu.recording import Episode, Recorder, RecordingError, Replay
from ai4u_edu.recording.episode import decode, encode

CASES = [
    ("box_chase", "world.gravity", 1.6),
    ("box_chase", "0.vision.noise", 0.05),
    ("box_chase", "0.vision.field_of_view", 90.0),
    ("box_chase", "0.move.move_amount", 3.5),
    ("box_chase", "0.min_dist.step_reward", -0.5),
    ("box_chase", "0.max_steps_per_episode", 4),
    ("box_chase", "bodies.box.mass", 20.0),
    ("box_chase", "bodies.robot.radius", 0.7),
    ("box_chase", "floors.plate.top", 0.5),
    ("forage", "0.reward_scale", 2.0),
    ("donut", "floors.track.outer", 7.8),
    ("sumo", "orange.brain.controller.speed", 0.1),
    ("sumo", "bodies.blue.mass", 3.0),
    ("line_follow", "world.damping", 0.5),
]


def drive(sim: ControlRequestor, seed: int, options: dict[str, Any] | None = None) -> list[Any]:
    """Return percepts and rewards of an episode's first decisions."""
    sim.reset(seed, options)
    agents = sim.agents
    seen: list[Any] = [each.percept.data for each in agents]
    for _ in range(8):
        sim.step()
        seen += [(each.percept.data, each.reward) for each in agents]
    return seen


def parameter(scene: Scene, name: str) -> NumberParameter:
    return next(each for each in number_parameters(scene) if each.name == name)


@pytest.mark.parametrize(("name", "number", "value"), CASES)
def test_an_episode_with_options_is_that_of_a_scene_with_these_numbers(
    name: str, number: str, value: float
) -> None:
    scene = Scene.load(name)
    sim, changed = scene.build(), with_value(scene, parameter(scene, number), value).build()
    before = drive(sim, 4)
    assert drive(sim, 4, {number: value}) == drive(changed, 4)
    assert sim.options.values == {number: value}
    assert drive(sim, 4) == before
    assert sim.options.values == {}


@pytest.mark.parametrize("name", Scene.names())
def test_numbers_have_the_names_that_vary_knows(name: str) -> None:
    scene = Scene.load(name)
    known = {
        name: each.value
        for name, each in scene.build().options.parameters().items()
        if not each.declared.is_pair and ".random." not in name
    }
    assert known == {each.name: each.value for each in number_parameters(scene)}


@pytest.mark.parametrize(
    ("options", "kind", "words"),
    [
        ({"gravty": 1}, NameNotFoundError, "did you mean 'world.gravity'"),
        ({"mass": 1}, NameNotFoundError, "bodies.robot.mass, bodies.box.mass"),
        ({"gravity": -1}, ParameterError, "gravity: expected at least 0, got -1"),
        ({"gravity": True}, ParameterError, "expected a number, got True"),
        ({"gravity": float("nan")}, ParameterError, "finite"),
        ({"gravity": 1, "world.gravity": 2}, ParameterError, "given twice"),
        ({"box.position": 3}, ParameterError, "expected two numbers"),
        ({"ticks_per_second": 30}, ParameterError, "make another environment"),
        ({"vision.noise": -1}, ParameterError, "noise: expected at least 0"),
        ({"vision.columns": 9}, SetupError, "sensor 'vision': expected numbers that keep"),
        ({"box.position": [9e3, 0], "vision.columns": 9}, SetupError, "keep its space"),
        ({"robot.position": [-2.39, 0]}, SetupError, "would overlap"),
        (["gravity"], ParameterError, "expected numbers by name"),
    ],
)
def test_wrong_options_are_refused_and_the_next_reset_is_as_ever(
    options: Any, kind: type[AI4UError], words: str
) -> None:
    sim = Scene.load("box_chase").build()
    sim.agents[0].actuators = [
        each for each in sim.agents[0].actuators if "respawn" not in str(each)
    ]
    before = drive(Scene.load("box_chase").build(), 2)
    sim.reset(1, {"gravity": 3})
    with pytest.raises(kind, match=words):
        sim.reset(2, options)
    assert drive(sim, 2) == before


def test_a_value_that_another_option_set_does_not_count_for_the_next_one() -> None:
    scene = Scene.load("box_chase")
    sim = scene.build()
    drive(sim, 4, {"bodies.box.mass": 20.0, "vision.noise": 0.1})
    changed = with_value(scene, parameter(scene, "bodies.box.height"), 2.0).build()
    assert drive(sim, 4, {"bodies.box.height": 2.0}) == drive(changed, 4)


def test_a_point_and_a_range_of_chance_can_be_set() -> None:
    sim = Scene.load("push_block").build()
    pairs = {name for name, each in sim.options.parameters().items() if each.declared.is_pair}
    ranges = sorted(name for name in pairs if name.endswith(".random.x"))
    assert ranges
    body = ranges[0].split(".")[1]
    for seed in range(5):
        sim.reset(seed, {ranges[0]: [1.0, 1.1]})
        assert 1.0 <= sim.world[body].position[0] <= 1.1
    with pytest.raises(ParameterError, match="smaller number first"):
        sim.reset(1, {ranges[0]: [2, 1]})


def test_a_copy_of_the_world_has_the_options() -> None:
    scene = Scene.load("box_chase")
    sim, copy = scene.build(), scene.build()
    sim.reset(3, {"gravity": 2.0, "vision.noise": 0.1})
    sim.step()
    copy.set_state(sim.get_state())
    assert copy.options.values == {"world.gravity": 2.0, "0.vision.noise": 0.1}
    assert [copy.step().data for _ in range(5)] == [sim.step().data for _ in range(5)]


def test_changeable_numbers_are_those_that_keep_the_spaces() -> None:
    sim = Scene.load("box_chase").build()
    sim.reset(1)
    known, changeable = sim.options.parameters(), sim.options.changeable()
    assert set(known) - set(changeable) == {
        "0.vision.stacked_observations",
        "0.vision.rows",
        "0.vision.columns",
        "0.orientation.stacked_observations",
        "0.last_action.stacked_observations",
        "0.last_action.action_size",
        "world.ticks_per_second",
    }


def test_samples_are_within_their_ranges() -> None:
    sim, rng = Scene.load("box_chase").build(), np.random.default_rng(1)
    ranges = {"gravity": (1, 2), "max_steps_per_episode": (3, 4), "box.size": (0.5, 0.6)}
    drawn = [sim.options.sample(ranges, rng) for _ in range(50)]
    assert {each["0.max_steps_per_episode"] for each in drawn} == {3, 4}
    assert all(1 <= each["world.gravity"] <= 2 for each in drawn)
    for options in drawn[:5]:
        sim.reset(1, options)
        assert sim.world["box"].description.shape.reach < 1


def recorded(options: dict[str, Any]) -> Episode:
    scene = Scene.load("box_chase")
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    drive(sim, 5, options)
    sim.reset(6)
    return recorder.episodes[-1]


def test_an_episode_records_its_options_and_is_replayed_with_them() -> None:
    episode = recorded({"gravity": 2.5, "bodies.box.position": (2, 2), "vision.noise": 0.1})
    options = {"world.gravity": 2.5, "bodies.box.position": [2, 2], "0.vision.noise": 0.1}
    assert episode.options == options
    read = decode(Episode, encode(episode), "file")
    assert read.options == options
    assert read.scene.world.gravity == 2.5
    assert Replay(read).verdict.exact
    assert "world.gravity 2.5" in str(read)


def test_an_episode_without_options_says_nothing_of_them() -> None:
    episode = recorded({})
    assert episode.options == {}
    assert b"options" not in decode(Episode, encode(episode), "file").scene.name.encode()


def test_options_that_are_no_numbers_are_refused_in_a_file() -> None:
    episode = recorded({"gravity": 2.5})
    object.__setattr__(episode, "options", {"world.gravity": float("inf")})
    with pytest.raises(RecordingError, match="options: expected finite numbers"):
        decode(Episode, encode(episode), "file")
