"""Whoever holds one key from the start of an episode is still in it two seconds later."""

from dataclasses import dataclass

import pytest

from ai4u_edu import Scene
from ai4u_edu.agent.cycle import ControlRequestor
from tests.scenes.few import SCENES

pytestmark = pytest.mark.slow

HELD_S = 2.0
SEEDS = pytest.mark.parametrize(
    "seeds", [range(20), pytest.param(range(20, 100), marks=pytest.mark.nightly)], ids=str
)
MAX_LOST = 0.05
"""Share of the episodes that may be lost."""
KEYS = ("KeyW", "KeyS", "KeyA", "KeyD")

EXPECTED_FALLS = {
    ("box_chase_ai4u", "KeyW"): "AI4U's poses face the edges, at AI4U's full speed",
    ("box_chase_ai4u", "KeyS"): "likewise",
    ("jumper", "KeyW"): "its goal is to jump; the blocks end after 4 m",
    ("jumper", "KeyS"): "likewise",
    ("platform", "KeyS"): "S jumps forward there, from one platform to the next",
    ("sumo", "KeyS"): "its goal is to stay in the ring, and the start is near the edge",
}
"""Keys that may lead to a fall, with the reason."""


@dataclass
class Count:
    """Ends of many episodes."""

    lost: int = 0
    won: int = 0


def hold(sim: ControlRequestor, key: str, seeds: range) -> Count:
    """Hold a key from the start of an episode, for each seed."""
    agent, count = sim.agents[0], Count()
    ticks = agent.brain.skip_frame + 1
    for seed in seeds:
        sim.reset(seed)
        for _ in range(round(HELD_S * sim.world.settings.ticks_per_second / ticks)):
            agent.keyboard.hold([key])
            sim.step()
            if agent.done:
                is_won = agent.ledger.episode_terms.get(sim.success, 0.0) > 0
                count.won += is_won
                count.lost += not is_won
                break
        agent.keyboard.release()
    return count


@SEEDS
@pytest.mark.parametrize("name", SCENES)
def test_a_key_held_for_two_seconds_seldom_loses_the_episode(name: str, seeds: range) -> None:
    sim = Scene.load(name).build()
    counts = {key: hold(sim, key, seeds) for key in KEYS}
    print(name, counts)
    lost = {key: count.lost for key, count in counts.items() if count.lost > MAX_LOST * len(seeds)}
    assert {key for key in lost if (name, key) not in EXPECTED_FALLS} == set(), lost


@SEEDS
def test_the_table_names_no_key_without_need(seeds: range) -> None:
    for name, key in EXPECTED_FALLS:
        lost = hold(Scene.load(name).build(), key, seeds).lost
        assert lost > MAX_LOST * len(seeds), (name, key)
