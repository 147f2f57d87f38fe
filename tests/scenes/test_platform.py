"""Platform: who is hungry dies, fruit feeds, and the ruby makes food of the spike."""

from typing import Any

import pytest

from ai4u_edu import ControlRequestor, LocalBrain, Scene

NOTHING, AHEAD = 0, 3


@pytest.fixture
def sim() -> ControlRequestor:
    """An agent that does nothing, until it is put somewhere; then it goes ahead."""
    sim = Scene.load("platform").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _percept: {"move": NOTHING}))
    sim.reset(1)
    return sim


def meet(sim: ControlRequestor, name: str) -> dict[str, Any]:
    """Runs into something from the west; what was paid, by term."""
    agent = sim.agents[0]
    agent.use_brain(LocalBrain(controller=lambda _percept: {"move": AHEAD}))
    x, y = sim.world[name].position
    agent.body.move_to(x - 1.5, y, heading=0.0)
    for _ in range(8):
        if not agent.done:
            sim.step()
    return agent.ledger.episode_terms


def inside(sim: ControlRequestor) -> list[float]:
    """Energy and power, as shares of 200 and 500."""
    shares: list[float] = sim.agents[0].percept["inside"].tolist()
    return shares


def test_who_waits_dies_of_hunger(sim: ControlRequestor) -> None:
    agent = sim.agents[0]
    while not agent.done:
        sim.step()
    assert agent.reward_terms["died"] == -100
    # 25 of energy, 1 for every 50 ticks; the zero has to be felt before it counts
    assert 25 * 50 < sim.world.ticks <= 25 * 50 + 10


def test_fruit_feeds(sim: ControlRequestor) -> None:
    paid = meet(sim, "fruit")
    assert sim.world["fruit"].fallen
    assert 0.6 < inside(sim)[0] < 0.625
    assert paid["homeostatic"] == pytest.approx(10 * 25 / 200)


def test_the_spike_kills(sim: ControlRequestor) -> None:
    assert meet(sim, "spike")["died"] == -100
    assert sim.agents[0].terminated


def test_with_the_ruby_the_spike_is_food(sim: ControlRequestor) -> None:
    meet(sim, "ruby")
    assert inside(sim)[1] == 1.0
    paid = meet(sim, "spike")
    assert paid["died"] == 0
    assert sim.world["spike"].fallen
    energy, power = inside(sim)
    assert energy > 0.55
    assert power == 0.0
    sim.agents[0].use_brain(LocalBrain(controller=lambda _percept: {"move": NOTHING}))
    for _ in range(41):
        sim.step()
    assert not sim.world["spike"].fallen, "back after 200 ticks"
