"""The scenes with several agents: who drives, who ends when, who gets what."""

from typing import Any

import pytest

from ai4u_edu import Command, ControlRequestor, LocalBrain, Scene
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.page.server.bindings import choose_agent
from tests.learn.envs.scenes import MULTI_AGENT

STILL = {"move": [0, 0, 0, 0]}


def built(name: str, seed: int = 1, *, still: bool = True) -> ControlRequestor:
    """A scene after its reset; all of its agents stand still, or do as their brains say."""
    sim = Scene.load(name).build()
    if still:
        for agent in sim.agents:
            agent.use_brain(LocalBrain(controller=lambda _percept: STILL))
    sim.reset(seed)
    return sim


@pytest.mark.parametrize("name", MULTI_AGENT)
def test_a_person_gets_the_first_agent_and_the_others_have_a_mind_of_their_own(name: str) -> None:
    sim = Scene.load(name).build()
    assert choose_agent(sim, None) is sim.agents[0]
    assert keys_of(sim.agents[0])["forward"] == ["KeyW", "ArrowUp"]
    for other in sim.agents[1:]:
        assert not keys_of(other)


@pytest.mark.parametrize("name", MULTI_AGENT)
def test_each_of_the_others_has_keys_at_hand_for_a_second_person(name: str) -> None:
    sim = built(name, still=False)
    first, second = sim.agents[:2]
    keys = [brain for brain in second.brains if not brain.enabled]
    second.use_brain(keys[0])
    assert choose_agent(sim, second.id) is second
    assert keys_of(second) == keys_of(first)
    first.keyboard.hold(["KeyW"])
    second.keyboard.hold(["KeyA"])
    sim.step()
    assert first.last_action["move"][0] > 0 == first.last_action["move"][1]
    assert second.last_action["move"][1] < 0 == second.last_action["move"][0]


@pytest.mark.parametrize("name", MULTI_AGENT)
def test_starts_vary_with_the_seed(name: str) -> None:
    sim = built(name)

    def starts(seed: int) -> Any:
        sim.reset(seed)
        return [body.pose for body in sim.world.bodies.values()]

    assert starts(1) == starts(1)
    assert len({tuple(starts(seed)) for seed in range(10)}) == 10


@pytest.mark.parametrize("name", MULTI_AGENT)
def test_the_others_move_and_each_seed_is_another_game(name: str) -> None:
    def played(seed: int) -> list[tuple[float, ...]]:
        sim = built(name, seed, still=False)
        sim.world.rebuild()
        for _ in range(60):
            sim.step()
        return [agent.body.pose for agent in sim.agents]

    assert played(1) == played(1)
    assert played(1) != played(2)


def test_who_falls_out_of_the_ring_loses_and_the_other_one_wins() -> None:
    sim = built("sumo")
    blue, orange = sim.agents
    blue.body.move_to(5, 0)
    while not orange.done:
        sim.step(orange)
    assert blue.reward_terms == {"win": 0.0, "fall": -10.0}
    assert orange.reward_terms == {"win": 10.0, "fall": 0.0}
    assert (blue.terminated, orange.terminated) == (True, True)


@pytest.mark.parametrize(("side", "winner"), [(1, "blue"), (-1, "orange")])
def test_a_goal_ends_it_for_all(side: int, winner: str) -> None:
    sim = built("soccer")
    sim.world["ball"].move_to(7.4 * side, 0.5)
    sim.step()
    for agent in sim.agents:
        won = agent.id.startswith(winner)
        assert agent.terminated
        assert agent.reward_terms == {"goal": 10.0 * won, "conceded": -10.0 * (not won)}


def test_the_ball_rolls_and_the_pitch_is_closed() -> None:
    sim = built("soccer")
    ball = sim.world["ball"]
    for vx, vy in ((14.0, 8.0), (-11.0, 12.0), (1.0, 15.0)):
        ball.move_to(0, 0)
        ball.set_velocity(vx, vy)
        for _ in range(240):
            sim.world.tick()
        assert (abs(ball.position[0]) < 8, abs(ball.position[1]) < 4.5) == (True, True)
    ball.move_to(0, 3)
    ball.set_velocity(4, 0)
    for _ in range(60):
        sim.world.tick()
    assert 1.5 < ball.position[0] < 4


def tagged() -> ControlRequestor:
    """A game of tag in which runner 2 is about to be caught."""
    sim = built("tag")
    x, y = sim.world["runner 2"].position
    sim.world["chaser"].move_to(x - 0.95, y, heading=0.0)
    ahead = {"move": [1, 0, 0, 0]}
    sim.agent("chaser").use_brain(LocalBrain(controller=lambda _percept: ahead))
    return sim


def test_a_tag_ends_the_episode_of_the_one_that_was_tagged() -> None:
    sim = tagged()
    runner, chaser = sim.agent("runner_2"), sim.agent("chaser")
    while not runner.done:
        sim.step(runner)
    assert runner.reward_terms == {"tagged": -10.0, "free": 0.0}
    assert [agent.done for agent in sim.agents] == [False, False, True, False]
    for _ in range(2):
        sim.step(chaser)
    assert chaser.ledger.episode_terms == {"catch": 10.0, "all": 0.0}
    assert chaser.percept["free"].tolist() == [1.0, 0.0, 1.0]
    assert sim.agent("runner_1").steps > runner.steps


def test_the_last_one_caught_is_the_end_for_the_chaser() -> None:
    sim = built("tag")
    chaser = sim.agent("chaser")
    for number in (3, 1, 2):
        assert not chaser.done
        sim.world[f"runner {number}"].move_to(*chaser.body.position)
        sim.step(chaser)
    assert chaser.terminated
    assert chaser.ledger.episode_terms == {"catch": 30.0, "all": 10.0}


def test_a_runner_that_was_caught_can_come_back_while_the_others_go_on() -> None:
    sim = tagged()
    runner = sim.agent("runner_2")

    def again(percept: Any) -> Any:
        return Command.RESPAWN if percept["done"] else STILL

    runner.use_brain(LocalBrain(controller=again))
    for _ in range(20):
        sim.tick()
    assert (runner.episode, runner.done, runner.body.fallen) == (2, False, False)
    assert sim.agent("runner_1").episode == 1
    assert 0 < runner.ledger.episode_total < sim.agent("runner_1").ledger.episode_total
    sim.step(sim.agent("chaser"))
    assert sim.agent("chaser").percept["free"].tolist() == [1.0, 1.0, 1.0]
    assert sim.agent("chaser").ledger.episode_terms["catch"] == 10.0
