"""Same scene, same seed, same actions: the same bytes, in another process too."""

import subprocess
import sys

import pytest

from ai4u_edu import Scene
from tests.scenes.few import FEW, SCENES
from tests.scenes.rollout import trajectory

pytestmark = pytest.mark.slow


def elsewhere(*names: str) -> dict[str, str]:
    """Return the trajectories of scenes in a process of their own, one at a time."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.scenes.rollout", "11", *names],
        capture_output=True,
        text=True,
        check=True,
    )
    return dict(line.split() for line in done.stdout.splitlines())


@pytest.fixture(scope="module")
def all_elsewhere(request: pytest.FixtureRequest) -> dict[str, str]:
    names = Scene.names() if request.config.getoption("nightly") else FEW
    return elsewhere(*reversed(names))


@pytest.mark.parametrize("name", SCENES)
def test_two_processes_agree_bit_for_bit(name: str, all_elsewhere: dict[str, str]) -> None:
    # other worlds and episodes have run before in both processes, in another order
    assert [trajectory(name, 11), trajectory(name, 11)] == [all_elsewhere[name]] * 2
    assert trajectory(name, 12) != all_elsewhere[name]


@pytest.mark.parametrize(
    "name",
    [
        Scene.names()[0],
        *(pytest.param(each, marks=pytest.mark.nightly) for each in Scene.names()[1:]),
    ],
)
def test_a_process_in_which_nothing_has_run_before_agrees(name: str) -> None:
    assert elsewhere(name) == {name: trajectory(name, 11)}


@pytest.mark.parametrize("name", SCENES)
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
