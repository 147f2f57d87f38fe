"""The ants of the scene find food by trails of ink."""

import pytest

from ai4u_edu import AntController, LocalBrain, Scene

pytestmark = pytest.mark.slow


def harvest(*, has_ink: bool) -> float:
    """Return how many loads the five ants that nobody drives bring home in a minute."""
    sim = Scene.load("ants").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))
    sim.reset(1)
    for _ in range(60 * 60):
        sim.tick()
        if not has_ink:
            sim.world.ink.clear()
    ants = sim.agents[1:]
    return sum(agent.ledger.episode_terms.get("harvest", 0.0) for agent in ants) / 10


def test_the_first_one_finds_food_by_the_controller_of_the_others() -> None:
    sim = Scene.load("ants").build()
    sim.agents[0].use_brain(AntController())
    sim.reset(1)
    for _ in range(60 * 60):
        sim.tick()
    assert sim.agents[0].ledger.episode_terms["harvest"] > 0


def test_without_ink_their_harvest_is_less_than_half() -> None:
    assert harvest(has_ink=False) < harvest(has_ink=True) / 2
