"""A newcomer at the keyboard who does what the page says wins within a few tries."""

import pytest

from ai4u_edu import Scene
from tests.scenes.few import SCENES, mostly_nightly
from tests.scenes.newcomer import Try, play
from tests.scenes.plans import PLANS

pytestmark = pytest.mark.slow

TRIES = 3
NEWCOMERS = 4
IDLE_S = 2.0

LEAST_WINS = {"soccer": 5}
"""Wins out of all tries where one win in every three is too much to expect."""


def tries(name: str) -> list[Try]:
    """Return the tries of all newcomers."""
    sim = Scene.load(name).build()
    return [play(sim, PLANS[name], seed) for seed in range(NEWCOMERS * TRIES)]


@pytest.mark.parametrize("name", mostly_nightly([each for each in PLANS if each not in LEAST_WINS]))
def test_each_newcomer_wins_one_of_three_tries(name: str) -> None:
    played = tries(name)
    for first in range(0, len(played), TRIES):
        assert any(each.won for each in played[first : first + TRIES]), played


@pytest.mark.nightly
@pytest.mark.parametrize("name", LEAST_WINS)
def test_a_team_game_is_won_now_and_then(name: str) -> None:
    assert sum(each.won for each in tries(name)) >= LEAST_WINS[name]


@pytest.mark.parametrize("name", SCENES)
def test_nobody_loses_in_the_first_two_seconds_without_a_key(name: str) -> None:
    sim = Scene.load(name).build()
    agent = sim.agents[0]
    decisions = IDLE_S * sim.world.settings.ticks_per_second / (agent.brain.skip_frame + 1)
    for seed in range(20):
        sim.reset(seed)
        for _ in range(round(decisions)):
            sim.step()
        assert not agent.done, seed


def test_whoever_only_waits_in_sumo_has_a_minute_or_is_pushed_out() -> None:
    """The time limit ends a fight without a winner."""
    sim = Scene.load("sumo").build()
    agent, opponent = sim.agents
    sim.reset(1)
    opponent.body.move_to(2.0, 0.0)
    while not agent.done:
        opponent.body.set_velocity(0.0, 0.0)
        opponent.body.move_to(2.0, 0.0)
        sim.step()
    assert agent.truncated
    assert not agent.ledger.episode_terms.get(sim.success)
    assert agent.steps * (agent.brain.skip_frame + 1) / 60 == 60
