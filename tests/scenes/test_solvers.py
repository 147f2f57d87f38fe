"""A few lines that see only what the agent senses solve every scene; chance solves none."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BasicAgent, LocalBrain, Percept, Scene
from ai4u_edu.envs.spaces_of import outputs_of
from tests.scenes.solvers import Driver, solver_of

SEEDS = range(20)


def chance(agent: BasicAgent, seed: int) -> Driver:
    """A driver that knows nothing."""
    spaces = {name: actuator.space() for name, actuator in outputs_of(agent).items()}
    for index, space in enumerate(spaces.values()):
        space.seed(1000 * seed + index)

    def drive(_percept: Percept) -> dict[str, Any]:
        return {name: np.asarray(space.sample()) for name, space in spaces.items()}

    return drive


def successes(name: str, driver: Callable[[BasicAgent, int], Driver]) -> list[int]:
    """The seeds on which the first agent reaches the goal; the others do as their brains say."""
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    brain = agent.brain
    won = []
    for seed in SEEDS:
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


@pytest.mark.parametrize("name", Scene.names())
def test_it_can_be_solved_on_20_of_20_seeds(name: str) -> None:
    assert successes(name, lambda _agent, _seed: solver_of(name)) == list(SEEDS)


@pytest.mark.parametrize("name", Scene.names())
def test_chance_does_not_solve_it(name: str) -> None:
    assert len(successes(name, chance)) < 4
