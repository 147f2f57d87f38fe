"""A few lines that see only what the agent senses solve every scene; random actions solve none."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BasicAgent, LocalBrain, Percept, Scene
from ai4u_edu.learn.envs.spaces_of import outputs_of
from tests.scenes.few import mostly_nightly
from tests.scenes.solvers import Driver, solver_of

pytestmark = pytest.mark.slow

SEEDS = pytest.mark.parametrize(
    "seeds", [range(2), pytest.param(range(2, 20), marks=pytest.mark.nightly)], ids=str
)
BOX_CHASE_SEEDS = range(100)


def random_driver(agent: BasicAgent, seed: int) -> Driver:
    """Return a driver of random actions."""
    spaces = {name: actuator.space() for name, actuator in outputs_of(agent).items()}
    for index, space in enumerate(spaces.values()):
        space.seed(1000 * seed + index)

    def drive(_percept: Percept) -> dict[str, Any]:
        return {name: np.asarray(space.sample()) for name, space in spaces.items()}

    return drive


def successes(name: str, driver: Callable[[BasicAgent, int], Driver], seeds: range) -> list[int]:
    """The seeds on which the first agent reaches the goal; the others do as their brains say."""
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    brain = agent.brain
    won = []
    for seed in seeds:
        agent.use_brain(
            LocalBrain(
                controller=driver(agent, seed),
                skip_frame=brain.skip_frame,
                repeat_action=brain.repeat_action,
            )
        )
        sim.reset(seed)
        while not agent.done:
            sim.step()
        if agent.ledger.episode_terms.get(str(scene.description.success), 0) > 0:
            won.append(seed)
    return won


@SEEDS
@pytest.mark.parametrize("name", Scene.names())
def test_it_can_be_solved_on_every_seed(name: str, seeds: range) -> None:
    assert successes(name, lambda _agent, _seed: solver_of(name), seeds) == list(seeds)


@SEEDS
@pytest.mark.parametrize(
    "name", mostly_nightly([each for each in Scene.names() if not each.startswith("box_chase")])
)
def test_random_actions_do_not_solve_it(name: str, seeds: range) -> None:
    assert len(successes(name, random_driver, seeds)) <= len(seeds) // 5


@pytest.mark.nightly
def test_random_actions_seldom_reach_the_box() -> None:
    """It does on 23 of the 100 seeds; from AI4U's own poses on 19."""
    assert len(successes("box_chase", random_driver, BOX_CHASE_SEEDS)) <= 25
