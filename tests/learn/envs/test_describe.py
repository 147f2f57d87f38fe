"""The description of an environment's numbers: names, units and ranges."""

from typing import Any

import pytest
from gymnasium import spaces

from ai4u_edu import FloatArrayCompositeSensor, OrientationSensor, Scene, VelocitySensor
from ai4u_edu.learn.envs import SceneEnv, parallel_env
from ai4u_edu.learn.envs.description import Element
from ai4u_edu.locale import reader
from tests.learn.envs.scenes import MULTI_AGENT, SCENES, first_agent


def first(scene: str, observation: str) -> SceneEnv:
    """Return an environment of a scene's first agent."""
    return SceneEnv(scene, observation=observation, agent=first_agent(scene))


def bounds(elements: tuple[Element, ...]) -> list[tuple[float, float]]:
    return [(each.low, each.high) for each in elements]


def told(element: Element) -> tuple[str, str, float, float]:
    return element.element, element.unit, element.low, element.high


def expected(space: spaces.Space[Any]) -> list[tuple[float, float]]:
    """Return the bounds of a space's numbers."""
    if isinstance(space, spaces.Discrete):
        return [(float(space.start), float(space.start + space.n - 1))]
    if isinstance(space, spaces.Dict):
        return [pair for part in space.values() for pair in expected(part)]
    assert isinstance(space, spaces.Box)
    return list(zip(space.low.ravel().tolist(), space.high.ravel().tolist(), strict=True))


@pytest.mark.parametrize("scene", SCENES)
def test_the_ranges_of_a_flat_observation_are_those_of_its_space(scene: str) -> None:
    env = first(scene, "flat")
    described = env.describe()
    assert [each.index for each in described.observations] == list(
        range(env.observation_space.shape[0])  # type: ignore[index]
    )
    assert bounds(described.observations) == expected(env.observation_space)
    assert len({(each.key, each.element) for each in described.observations}) == len(
        described.observations
    )


@pytest.mark.parametrize("scene", SCENES)
def test_the_ranges_of_a_dict_observation_are_those_of_each_key(scene: str) -> None:
    env = first(scene, "dict")
    described = env.describe().by_sensor
    assert isinstance(env.observation_space, spaces.Dict)
    assert list(described) == list(env.observation_space)
    for key, space in env.observation_space.items():
        assert bounds(described[key]) == expected(space)
        assert [each.index for each in described[key]] == list(range(len(described[key])))


@pytest.mark.parametrize("scene", SCENES)
def test_the_ranges_of_an_action_are_those_of_its_space(scene: str) -> None:
    env = first(scene, "flat")
    assert bounds(env.describe().actions) == expected(env.action_space)
    assert str(env.describe()).count("\n") > len(env.describe().actions)


@pytest.mark.parametrize("scene", MULTI_AGENT)
def test_every_agent_of_a_parallel_environment_is_described(scene: str) -> None:
    env = parallel_env(scene, observation="flat")
    for agent in env.possible_agents:
        described = env.describe(agent)
        assert bounds(described.observations) == expected(env.observation_space(agent))
        assert bounds(described.actions) == expected(env.action_space(agent))


def agent_with(*sensors: Any, observation: str = "flat") -> SceneEnv:
    """Return box_chase with other sensors."""
    from ai4u_edu.scenes import SceneDescription
    from ai4u_edu.scenes.serialization import to_plain

    plain = {**Scene.load("box_chase").plain(), "success": None}
    plain["agents"] = [
        {**plain["agents"][0], "rewards": [], "sensors": [to_plain(each) for each in sensors]}
    ]
    return SceneEnv(Scene(SceneDescription.model_validate(plain)), observation=observation)


def test_a_stacked_and_delayed_reading_says_which_decision_it_is_of() -> None:
    env = agent_with(VelocitySensor(stacked_observations=2, delay=1))
    names = [each.element for each in env.describe().observations]
    assert names == [
        "forward, 2 decisions ago",
        "left, 2 decisions ago",
        "turning, 2 decisions ago",
        "forward, 1 decision ago",
        "left, 1 decision ago",
        "turning, 1 decision ago",
    ]


def test_the_table_is_in_the_readers_language() -> None:
    env = agent_with(VelocitySensor(delay=2), observation="flat")
    with reader("pt_BR"):
        head, row, *_ = str(env.describe()).splitlines()
    assert head.split() == ["índice", "sensor", "elemento", "unidade", "mínimo", "máximo"]
    assert "forward, há 2 decisões" in row


def test_the_ages_are_those_of_the_readings() -> None:
    env = agent_with(VelocitySensor(stacked_observations=3), VelocitySensor(perception_key="now"))
    place = {(each.key, each.element): each.index for each in env.describe().observations}
    env.reset(seed=1)
    turning = []
    for turn in (0.1, 0.5, 0.9):
        observation, *_ = env.step([0.0, turn, 0.0, 0.0])
        turning.append(observation[place["now", "turning"]])
    assert len(set(turning)) == 3
    assert turning == [
        observation[place["velocity", f"turning, {age}"]]
        for age in ("2 decisions ago", "1 decision ago", "now")
    ]


def test_a_normalised_reading_has_its_own_range_and_no_unit() -> None:
    plain = agent_with(VelocitySensor(max_speed=8)).describe().observations
    scaled = agent_with(VelocitySensor(max_speed=8, normalized=True)).describe().observations
    assert [told(each) for each in plain] == [
        ("forward", "m/s", -8, 8),
        ("left", "m/s", -8, 8),
        ("turning", "rad/s", -20, 20),
    ]
    assert [told(each) for each in scaled] == [
        ("forward", "", -1, 1),
        ("left", "", -1, 1),
        ("turning", "", -1, 1),
    ]


def test_a_distance_in_metres_says_so() -> None:
    far = OrientationSensor(target="box", normalized=False)
    described = agent_with(far).describe().observations
    assert [(each.element, each.unit) for each in described] == [("cosine", ""), ("distance", "m")]


def test_a_composite_names_its_children() -> None:
    inside = VelocitySensor(normalized=True, perception_key="speed", stacked_observations=2)
    described = agent_with(FloatArrayCompositeSensor(sensors=[inside])).describe().by_sensor
    assert [each.element for each in described["array"]][2:4] == [
        "speed: turning, 1 decision ago",
        "speed: forward, now",
    ]


def test_text_has_no_numbers() -> None:
    from ai4u_edu import IDSensor

    env = agent_with(VelocitySensor(), IDSensor(is_input=True), observation="dict")
    assert list(env.describe().by_sensor) == ["velocity"]
    assert "id" in env.observation_space.sample()
