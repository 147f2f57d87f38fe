"""Same scene, same seed, same actions: the same bytes, in another process too."""

import subprocess
import sys

import pytest

from ai4u_edu import Scene
from tests.scenes.rollout import trajectory


@pytest.mark.parametrize("name", Scene.names())
def test_two_processes_agree_bit_for_bit(name: str) -> None:
    # other worlds and episodes have run in this process before; in that one, none
    here = [trajectory(name, 11), trajectory(name, 11)]
    there = subprocess.run(
        [sys.executable, "-m", "tests.scenes.rollout", name, "11"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert [there.stdout.strip()] * 2 == here
    assert trajectory(name, 12) != here[0]


@pytest.mark.parametrize("name", Scene.names())
def test_any_episode_of_a_long_run_can_be_played_again_from_its_seed(name: str) -> None:
    sim = Scene.load(name).build()
    sim.reset(3)
    for _ in range(5):
        sim.step()
        sim.reset()
    seed = sim.world.seeds.seed
    there = [sim.step().data for _ in range(20)]
    other = Scene.load(name).build()
    other.reset(seed)
    assert [other.step().data for _ in range(20)] == there
