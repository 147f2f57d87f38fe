"""Chance comes from one seed an episode."""

import re
from collections.abc import Callable
from typing import Any
from zlib import crc32

import numpy as np
import pytest

from ai4u_edu import Scene, World
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.base.seeding import MAX_SEED, Seeds, checked_seed, seeds_from
from ai4u_edu.envs import SceneEnv, SceneVectorEnv
from ai4u_edu.envs.scene_parallel_env import SceneParallelEnv
from ai4u_edu.recording import Recorder

BAD_SEEDS = [
    *(-1, MAX_SEED + 1, 10**20, 10**5000, 1.0, 1e20, float("nan"), float("inf")),
    *("7", None, True, np.bool_(True), [7], np.float64(3.0), b"7"),
]
NEAR_THE_END = [0, 7, 2**32 - 1, 2**32, 2**53 + 1, MAX_SEED]


def test_children_do_not_depend_on_each_other() -> None:
    one, other = Seeds(5), Seeds(5)
    other.child("a").random(100)
    assert one.child("b").random() == other.child("b").random()


def test_the_next_episode_follows_from_the_seed_alone() -> None:
    one, other = Seeds(5), Seeds(5)
    other.generator.random(100)
    assert one.next().seed == other.next().seed != 5


@pytest.mark.parametrize("seed", NEAR_THE_END)
def test_a_generator_is_numpys_own_of_the_seed_and_the_names_checksum(seed: int) -> None:
    for name in ("", "vision", "random/box 1"):
        expected = np.random.default_rng([seed, crc32(name.encode())])
        assert Seeds(seed).child(name).random(5).tolist() == expected.random(5).tolist()


@pytest.mark.parametrize("seed", BAD_SEEDS, ids=range(len(BAD_SEEDS)))
def test_a_bad_seed_is_refused_in_a_sentence(seed: Any) -> None:
    for take in (Seeds, checked_seed, lambda seed: World(seed=seed)):
        with pytest.raises(ParameterError) as caught:
            take(seed)
        text = str(caught.value)
        assert text.startswith(f"seed: expected a whole number from 0 to {MAX_SEED}, got ")
        assert len(text) < 200


def test_numpys_whole_numbers_are_seeds() -> None:
    for seed in (np.int64(7), np.uint8(7), np.int32(7)):
        found = Seeds(seed).seed  # type: ignore[arg-type]  # as NumPy's users write it
        assert (found, type(found)) == (7, int)


def _reset_of(make: Callable[[], Any]) -> Callable[[], tuple[Any, Callable[[Any], Any]]]:
    def made() -> tuple[Any, Callable[[Any], Any]]:
        thing = make()
        return thing.sim if hasattr(thing, "sim") else thing, lambda seed: thing.reset(seed=seed)

    return made


RESETS = {
    "sim": _reset_of(lambda: Scene.load("box_chase").build()),
    "env": _reset_of(lambda: SceneEnv("box_chase")),
    "parallel": _reset_of(lambda: SceneParallelEnv("soccer")),
}


@pytest.mark.parametrize("name", RESETS)
def test_a_refused_seed_leaves_the_world_as_it_was(name: str) -> None:
    sim, reset = RESETS[name]()
    reset(5)
    for _ in range(3):
        sim.step()
    heard: list[str] = []
    sim.agents[0].before_the_reset.connect(lambda _: heard.append("reset"))

    def state() -> Any:
        poses = [(body.position, body.heading) for body in sim.world.bodies.values()]
        return sim.episode, sim.world.ticks, sim.world.seeds.seed, poses

    before = state()
    for seed in (-1, MAX_SEED + 1, 10**20, 1.5, "x"):
        with pytest.raises(ParameterError, match=r"^seed: expected a whole number"):
            reset(seed)
    assert (state(), heard) == (before, [])
    sim.step()


def test_a_refused_seed_of_a_bare_world_leaves_it_as_it_was() -> None:
    world = World(seed=5)
    with pytest.raises(ParameterError):
        world.reset(-1)
    assert world.seeds.seed == 5
    world.reset()
    assert world.seeds.seed == Seeds(5).next().seed


@pytest.mark.parametrize("seed", [-1, MAX_SEED, [1, -1], [3, MAX_SEED + 1]])
def test_of_many_worlds_none_begins_anew_with_a_refused_seed(seed: Any) -> None:
    worlds = SceneVectorEnv(2, "box_chase")
    worlds.reset(seed=3)
    episodes = [env.sim.episode for env in worlds.envs]
    with pytest.raises(ParameterError):
        worlds.reset(seed=seed)
    assert [env.sim.episode for env in worlds.envs] == episodes
    assert [env.sim.world.seeds.seed for env in worlds.envs] == [3, 4]


def test_the_largest_seed_can_be_recorded_and_read_again() -> None:
    from ai4u_edu.recording import Episode
    from ai4u_edu.recording.episode import decode, encode

    env = SceneEnv("box_chase")
    recorder = Recorder(env.sim)
    env.reset(seed=MAX_SEED)
    env.step(env.action_space.sample())
    recorder.finish()
    episode = decode(Episode, encode(recorder.episodes[-1]), "x")
    assert episode.seed == MAX_SEED


def test_gymnasiums_meaning_of_no_seed_is_kept() -> None:
    env = SceneEnv("box_chase")
    env.reset(seed=7)
    env.reset()
    first = env.sim.world.seeds.seed
    env.reset(seed=7)
    env.reset(seed=None)
    assert env.sim.world.seeds.seed == first == Seeds(7).next().seed


def test_seeds_one_by_one_have_an_end() -> None:
    assert list(seeds_from(MAX_SEED - 1, 2)) == [MAX_SEED - 1, MAX_SEED]
    with pytest.raises(ParameterError, match=re.escape(f"room for 3 seeds up to {MAX_SEED}")):
        seeds_from(MAX_SEED - 1, 3)
    with pytest.raises(ParameterError):
        seeds_from(-1, 1)
