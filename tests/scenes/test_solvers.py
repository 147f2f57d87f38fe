"""Every scene can be solved, by a few lines that see only what the agent senses; chance can't."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Percept, Scene

Action = dict[str, Any]


def seek(cosine: float, sine: float, leap: float = 0.0) -> Action:
    """Turns towards a direction, and drives once it is about ahead."""
    ahead = 1.0 if cosine > 0.9 else 0.0
    return {"move": [ahead, -np.clip(2 * math.atan2(sine, cosine), -1, 1), 0, leap]}


def box_chase() -> Callable[[Percept], Action]:
    """With a cosine alone: turns until it is large, then drives."""

    def drive(percept: Percept) -> Action:
        cosine = percept["orientation"][0]
        return {"move": [1.0, 0, 0, 0] if cosine > 0.99 else [0, 0.2, 0, 0]}

    return drive


def sample_scene() -> Callable[[Percept], Action]:
    """With the bearing; it leaps when it sees the low wall right ahead."""

    def drive(percept: Percept) -> Action:
        sine, cosine = (float(each) for each in percept["bearing"])
        codes, distances = percept["vision"][:, 1, 4]  # straight ahead, 10 degrees down
        wall = codes == 1.0 and distances * 15 < 1.8
        return seek(cosine, sine, leap=float(wall))

    return drive


def jumper() -> Callable[[Percept], Action]:
    """Along the middle line; it leaps where a block ends."""

    def drive(percept: Percept) -> Action:
        x, y = percept["position"][0] * 35.0, percept["position"][1] * 35.0
        sine, cosine = percept["heading"]
        wanted = math.atan2(-y, 4.0) - math.atan2(sine, cosine)
        edge = (x + 2) % 7 > 3.3 and x < 27
        return seek(math.cos(wanted), math.sin(wanted), float(edge and abs(wanted) < 0.3))

    return drive


SOLVERS = {"box_chase": box_chase, "jumper": jumper, "sample_scene": sample_scene}


def chance(seed: int) -> Callable[[Percept], Action]:
    """A driver that knows nothing."""
    generator = np.random.default_rng(seed)
    return lambda _percept: {"move": generator.uniform([-1, -1, 0, 0], 1)}


def successes(name: str, driver: Callable[[int], Callable[[Percept], Action]]) -> int:
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    won = 0
    for seed in range(20):
        agent.use_brain(LocalBrain(controller=driver(seed)))
        sim.reset(seed)
        while not agent.done:
            sim.step()
        won += agent.ledger.episode_terms.get(str(scene.description.success), 0) > 0
    return won


@pytest.mark.parametrize("name", Scene.names())
def test_it_can_be_solved_on_20_of_20_seeds_and_not_by_chance(name: str) -> None:
    assert successes(name, lambda _seed: SOLVERS[name]()) == 20
    assert successes(name, chance) < 4
