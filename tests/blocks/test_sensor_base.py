"""The base of sensors: stacking, normalising, noise, delay, dropout, on and off."""

from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box, Discrete, MultiBinary, MultiDiscrete, Sequence, Space, Text
from hypothesis import given
from hypothesis import strategies as st

from ai4u_edu import (
    FloatArrayCompositeSensor,
    IDSensor,
    LocalBrain,
    LocalGridSensor,
    PositionSensor,
    Scene,
    Sensor,
)
from ai4u_edu.agent.rebind import sense_again
from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.brains.links.ai4u import AI4UCodec
from ai4u_edu.blocks.brains.links.link import Observation, describe_agent
from ai4u_edu.check.rollout import RandomDrive
from tests.builders import small_sim


class Counter(Sensor):
    """Reads [n, -n] at the n-th reading of the episode."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def space(self) -> Box:
        return Box(-10.0, 100.0, (2,))

    def on_reset(self, agent: Any, view: Any) -> None:
        self.count = 0

    def read(self, body: Any, view: Any) -> tuple[float, float]:
        self.count += 1
        return (self.count, -self.count)


class Constant(Sensor):
    """Always reads 5."""

    def space(self) -> Box:
        return Box(0.0, 10.0, (1,))

    def read(self, body: Any, view: Any) -> float:
        return 5.0


def readings(sensor: Sensor, steps: int, seed: int = 0) -> list[Any]:
    sim = small_sim([sensor])
    sim.reset(seed=seed)
    found = [sim.agents[0].percept[sensor.perception_key]]
    found += [sim.step()[sensor.perception_key] for _ in range(steps)]
    return [np.asarray(each).tolist() for each in found]


def test_plain() -> None:
    assert readings(Counter(), 2) == [[1, -1], [2, -2], [3, -3]]


def test_the_stack_is_filled_with_the_first_reading_and_is_oldest_first() -> None:
    assert readings(Counter(stacked_observations=3), 3) == [
        [[1, -1], [1, -1], [1, -1]],
        [[1, -1], [1, -1], [2, -2]],
        [[1, -1], [2, -2], [3, -3]],
        [[2, -2], [3, -3], [4, -4]],
    ]


def test_a_reset_empties_the_stack() -> None:
    sim = small_sim([Counter(stacked_observations=2)])
    sim.step()
    sim.reset()
    assert sim.agents[0].percept["counter"].tolist() == [[1, -1], [1, -1]]


def test_what_is_not_resetable_keeps_its_stack() -> None:
    sim = small_sim([Counter(stacked_observations=2, resetable=False)])
    sim.step()
    sim.reset()
    assert sim.agents[0].percept["counter"].tolist() == [[2, -2], [3, -3]]


def test_delay_shows_what_was_read_before() -> None:
    assert readings(Counter(delay=2), 4) == [[1, -1], [1, -1], [1, -1], [2, -2], [3, -3]]


def test_normalised_is_divided_by_the_largest_bound() -> None:
    sensor = Counter(normalized=True)
    assert readings(sensor, 1) == [
        pytest.approx([0.01, -0.01]),
        pytest.approx([0.02, -0.02]),
    ]
    space = sensor.observation_space()
    assert isinstance(space, Box)
    assert (float(space.low[0]), float(space.high[0])) == pytest.approx((-0.1, 1.0))


def test_noise_has_the_deviation_it_says_and_stays_inside_the_space() -> None:
    found = np.array(readings(Constant(noise=1.0), 3000)).ravel()
    assert np.std(found) == pytest.approx(1.0, rel=0.1)
    assert np.mean(found) == pytest.approx(5.0, abs=0.1)
    wild = np.array(readings(Constant(noise=50.0), 300))
    assert wild.min() == 0.0
    assert wild.max() == 10.0


def test_noise_comes_from_the_worlds_seed() -> None:
    assert readings(Constant(noise=1.0), 5, seed=3) == readings(Constant(noise=1.0), 5, seed=3)
    assert readings(Constant(noise=1.0), 5, seed=3) != readings(Constant(noise=1.0), 5, seed=4)


def test_two_sensors_have_noise_of_their_own() -> None:
    sensors = [Constant(noise=1.0, perception_key=key) for key in ("a", "b")]
    percept = small_sim(sensors).agents[0].percept
    assert percept["a"] != percept["b"]


def test_dropout_keeps_the_reading_before() -> None:
    sim = small_sim([Counter(dropout=0.5)])
    before, repeated = 1.0, 0
    for _ in range(1000):
        now = float(sim.step()["counter"][0])
        assert now in {before, before + 1}
        repeated += now == before
        before = now
        if before > 90:
            sim.reset()
            before = 1.0
    assert 400 < repeated < 600


def test_dropout_1_never_reads_again_and_0_always() -> None:
    assert readings(Counter(dropout=1.0), 3) == [[1, -1]] * 4


def test_a_lost_reading_is_not_taken() -> None:
    sensor = Counter(dropout=1.0)
    sim = small_sim([sensor])
    sim.step()
    assert sensor.count == 1


def test_percepts_are_frozen_and_share_nothing() -> None:
    sim = small_sim([Counter()])
    first = sim.agents[0].percept["counter"]
    with pytest.raises(ValueError, match="read-only"):
        first[0] = 7
    sim.step()
    assert first.tolist() == [1, -1]


@pytest.mark.parametrize(
    ("space", "normalized", "kind"),
    [
        (Box(0, 1, (2,)), False, "sfloatarray"),
        (Box(0, 255, (2,), np.uint8), False, "sbytearray"),
        (Box(0, 255, (2,), np.uint8), True, "sfloatarray"),
        (Box(0, 9, (2,), np.int32), False, "sintarray"),
        (Discrete(4), False, "sint"),
        (Text(5), False, "sstring"),
    ],
)
def test_the_kind_follows_from_the_space(space: Any, normalized: bool, kind: str) -> None:
    class Any_(Sensor):
        """Has some space."""

        def space(self) -> Any:
            return space

    assert Any_(normalized=normalized).reading_kind() == kind


@given(
    stack=st.integers(1, 5),
    delay=st.integers(0, 4),
    normalized=st.booleans(),
    steps=st.integers(0, 12),
)
def test_every_combination_stays_in_its_space_and_is_in_order(
    stack: int, delay: int, normalized: bool, steps: int
) -> None:
    sensor = Counter(stacked_observations=stack, delay=delay, normalized=normalized)
    found = np.array(readings(sensor, steps)[-1]).reshape(stack, 2)[:, 0]
    found = np.round(found * (100 if normalized else 1))
    expected = [max(1, steps + 1 - delay - age) for age in reversed(range(stack))]
    assert found.tolist() == expected


def percepts(name: str) -> list[bytes]:
    sim = Scene.load(name).build(seed=3)
    drives = [RandomDrive(agent) for agent in sim.agents]
    for agent, drive in zip(sim.agents, drives, strict=True):
        agent.use_brain(LocalBrain(controller=drive, skip_frame=agent.brain.skip_frame))
    sim.reset(seed=3)
    return [sim.step().data for _ in range(60)]


@pytest.mark.parametrize("name", Scene.names())
def test_both_paths_into_memory_give_the_same_bits(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    direct = percepts(name)
    monkeypatch.setattr(Sensor, "_read_direct", Sensor._read_filtered)
    assert percepts(name) == direct


# -- choices and texts -----------------------------------------------------------------------------


class Choice(Sensor):
    """Reads 3, 4, 5, 6, 3, ... of the choices 3 to 6."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = -1

    def on_reset(self, agent: Any, view: Any) -> None:
        self.count = -1

    def space(self) -> Space[Any]:
        return Discrete(4, start=3)

    def read(self, body: Any, view: Any) -> Any:
        self.count += 1
        return 3 + self.count % 4


class Flag(Choice):
    """Reads false, true, false, ..."""

    kind = "sbool"

    def space(self) -> Space[Any]:
        return Discrete(2)

    def read(self, body: Any, view: Any) -> Any:
        self.count += 1
        return bool(self.count % 2)


class Amount(Flag):
    """Reads 0, 1, 0, ... as one float."""

    kind = "sfloat"

    def space(self) -> Space[Any]:
        return Box(0.0, 1.0, ())


class Flags(Choice):
    """Reads two bits."""

    def space(self) -> Space[Any]:
        return MultiBinary(2)

    def read(self, body: Any, view: Any) -> Any:
        self.count += 1
        return [self.count % 2, 1]


class Choices(Choice):
    """Reads two choices."""

    def space(self) -> Space[Any]:
        return MultiDiscrete([4, 2])

    def read(self, body: Any, view: Any) -> Any:
        self.count += 1
        return [self.count % 4, 1]


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        (Choice, [[3, 3], [3, 4], [4, 5]]),
        (Flag, [[0, 0], [0, 1], [1, 0]]),
        (Amount, [[0, 0], [0, 1], [1, 0]]),
        (Flags, [[[0, 1], [0, 1]], [[0, 1], [1, 1]], [[1, 1], [0, 1]]]),
        (Choices, [[[0, 1], [0, 1]], [[0, 1], [1, 1]], [[1, 1], [2, 1]]]),
    ],
)
def test_choices_and_single_numbers_stack(kind: type[Sensor], expected: list[Any]) -> None:
    sensor = kind(stacked_observations=2)
    assert readings(sensor, 2) == expected
    space = sensor.observation_space()
    assert isinstance(space, Box)
    assert all(np.asarray(each, space.dtype) in space for each in expected)


@pytest.mark.parametrize("kind", [Choice, Flag, Amount, Flags, Choices])
def test_a_stack_of_choices_can_be_sent_to_an_ai4u_script(kind: type[Sensor]) -> None:
    sim = small_sim([kind(stacked_observations=3)])
    sim.reset(0)
    agent = sim.agents[0]
    codec = AI4UCodec(describe_agent(agent, skip_frame=4, repeat_action=True, tick=1 / 60))
    observation = Observation(
        1, 1, agent.percept, 0.0, {}, 0, 0, False, False, paused=False, stopped=False
    )
    assert codec.state(observation).sensors


def test_choices_in_a_composite_stack() -> None:
    composite = FloatArrayCompositeSensor(
        sensors=[Choice(stacked_observations=2)], range_min=0, range_max=10
    )
    assert readings(composite, 2) == [[3, 3], [3, 4], [4, 5]]


def test_choices_are_normalised() -> None:
    sensor = Choice(normalized=True)
    assert readings(sensor, 2) == [pytest.approx(each) for each in (3 / 6, 4 / 6, 5 / 6)]
    assert np.array(5 / 6, np.float32) in sensor.observation_space()
    assert readings(Flag(normalized=True), 1) == [False, True]


class Word(Sensor):
    """Reads a word."""

    def space(self) -> Space[Any]:
        return Text(10)

    def read(self, body: Any, view: Any) -> Any:
        return "word"


class Words(Word):
    """Reads words."""

    def space(self) -> Space[Any]:
        return Sequence(Text(10))

    def read(self, body: Any, view: Any) -> Any:
        return ["a", "word"]


@pytest.mark.parametrize("kind", [Word, Words, IDSensor])
@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("stacked_observations", 3),
        ("normalized", True),
        ("noise", 0.5),
        ("delay", 2),
        ("dropout", 0.5),
    ],
)
def test_attributes_of_numbers_are_refused_for_texts(
    kind: type[Sensor], name: str, value: Any
) -> None:
    says = rf"expected {name} (1|False|0) \(texts are no numbers\), got {value}"
    with pytest.raises(BlockError, match=says):
        small_sim([kind(**{name: value})])


@pytest.mark.parametrize("kind", [Choice, Flag, Flags, Choices])
def test_noise_is_refused_for_choices(kind: type[Sensor]) -> None:
    with pytest.raises(BlockError, match=r"expected noise 0 \(choices can't be a little wrong"):
        small_sim([kind(noise=0.1)])


def test_a_moment_that_is_read_again_leaves_the_older_readings() -> None:
    place = PositionSensor(stacked_observations=2)
    sensors = [
        LocalGridSensor(channels=["target"], cell_size=0.2, stacked_observations=2),
        FloatArrayCompositeSensor(
            sensors=[place], range_min=-50, range_max=50, stacked_observations=2
        ),
    ]
    sim = small_sim(sensors, controller=lambda percept: {"move": [1, 0.2, 0, 0]})
    agent = sim.agents[0]
    for _ in range(30):
        before = sim.step()
    sense_again(agent)
    for key in ("local_grid", "array"):
        assert agent.percept[key].tolist() == before[key].tolist()
