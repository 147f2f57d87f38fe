"""Recorded episodes as data to learn from."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training.demonstrations import demonstrations
from ai4u_edu.recording import Episode, Recorder, RecordingError
from tests.recording.recorded_drives import LEFT, RESPAWN, driver, field_of, take


def shown(scene: str, observation: str, seeds: tuple[int, ...]) -> tuple[list[Episode], list[Any]]:
    """Episodes in an environment, and what it gave back."""
    env = SceneEnv(scene, observation=observation)
    recorder = Recorder(env.sim, scene=env.scene.description)
    env.action_space.seed(1)
    kept = []
    for seed in seeds:
        rows: list[Any] = [(env.reset(seed=seed)[0],)]
        for _ in range(15):
            action = env.action_space.sample()
            rows.append((action, *env.step(action)))
            if rows[-1][3]:
                break
        kept.append(rows)
    recorder.finish()
    return list(recorder.episodes), kept


def rows_of(data: Any, index: int) -> Any:
    return (
        {key: each[index] for key, each in data.items()} if isinstance(data, dict) else data[index]
    )


def same(one: Any, other: Any) -> bool:
    if isinstance(one, dict):
        return (
            all(np.array_equal(one[key], other[key]) for key in one) and one.keys() == other.keys()
        )
    return np.array_equal(one, other)


@pytest.mark.parametrize("observation", ["flat", "dict"])
@pytest.mark.parametrize("scene", ["box_chase", "grid_world"])
def test_they_are_what_the_environment_gave(scene: str, observation: str) -> None:
    episodes, kept = shown(scene, observation, (3, 4))
    data = demonstrations(episodes, observation=observation)
    env = SceneEnv(scene, observation=observation)
    assert data.observation_space == env.observation_space
    assert data.action_space == env.action_space
    for demonstration, (first, *rows) in zip(data.episodes, kept, strict=True):
        assert len(demonstration) == len(rows)
        assert same(rows_of(demonstration.observations, 0), first[0])
        for index, (action, seen, reward, terminated, truncated, _) in enumerate(rows):
            # what was out of range was cut by the actuator
            assert np.allclose(rows_of(demonstration.actions, index), action)
            assert same(rows_of(demonstration.observations, index + 1), seen)
            assert demonstration.rewards[index] == reward
            assert demonstration.terminations[index] == terminated
            assert demonstration.truncations[index] == truncated


def test_an_agent_that_began_anew_gives_several() -> None:
    sim = field_of(driver("a", [LEFT] * 4 + [RESPAWN] + [LEFT] * 3 + [RESPAWN]))
    recorder = Recorder(sim)
    sim.reset(0)
    for _ in range(40):
        sim.tick()
    recorder.finish()
    data = demonstrations(recorder.episodes)
    assert [len(each) for each in data.episodes] == [4, 3, 5]
    for each in data.episodes:
        assert each.observations[0][-2:].tolist() == data.episodes[0].observations[0][-2:].tolist()


def test_episodes_of_one_scene() -> None:
    with pytest.raises(RecordingError, match="expected episodes of one scene, got 'box_chase' and"):
        demonstrations([take("box_chase", decisions=3).episode, take("donut", decisions=3).episode])
    with pytest.raises(RecordingError, match="expected recorded episodes with decisions in them"):
        demonstrations([])


@pytest.mark.parametrize("observation", ["flat", "dict"])
def test_a_minari_dataset(
    observation: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    minari = pytest.importorskip("minari")
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    episodes, _ = shown("box_chase", observation, (3, 4))
    data = demonstrations(episodes, observation=observation)
    data.to_minari("box_chase/test-v0", author="somebody")
    loaded = minari.load_dataset("box_chase/test-v0")
    assert loaded.total_episodes == 2
    assert loaded.total_steps == data.decisions
    for there, here in zip(loaded.iterate_episodes(), data.episodes, strict=True):
        for index in range(len(here) + 1):
            assert same(rows_of(there.observations, index), rows_of(here.observations, index))
        assert np.array_equal(there.actions, here.actions)
        assert there.rewards.tolist() == here.rewards.tolist()
        assert there.terminations.tolist() == here.terminations.tolist()
    with pytest.raises(SetupError, match="there is a dataset 'box_chase/test-v0' already"):
        data.to_minari("box_chase/test-v0")


def test_minari_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ai4u_edu.base.optional_deps.find_spec", lambda name: None)
    data = demonstrations([take("box_chase", decisions=3).episode])
    with pytest.raises(SetupError, match=r'pip install "ai4u-edu\[data\]"'):
        data.to_minari("x-v0")
