"""Messages to the page about the end of an episode are true."""

import math
from dataclasses import replace
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.page.server.input_messages import key_labels, usable_keys
from ai4u_edu.snapshot import AgentState, Snapshot, capture_snapshot
from tests.builders import small_sim


def sim_of(scene: str) -> ControlRequestor:
    sim = Scene.load(scene).build()
    sim.reset(1)
    return sim


def picture(scene: str, changes: dict[str, dict[str, Any]]) -> Snapshot:
    """A scene in which some agents are as said."""
    whole = capture_snapshot(sim_of(scene))
    agents = (agent._replace(**changes.get(agent.id, {})) for agent in whole.agents)
    return replace(whole, agents=tuple(agents))


def end_of(whole: Snapshot, agent: AgentState) -> str:
    return agent.outcome(whole.agents, whole.static_scene.success)


def outcomes(scene: str, **changes: dict[str, Any]) -> dict[str, str]:
    whole = picture(scene, changes)
    return {agent.id: end_of(whole, agent) for agent in whole.agents}


OVER = {"terminated": True}


@pytest.mark.parametrize(
    ("ended", "word"),
    [
        ({}, ""),
        (OVER | {"succeeded": True}, "goal"),
        (OVER | {"succeeded": True, "fell": True}, "goal"),
        (OVER | {"fell": True, "episode_reward": 3.0}, "fell"),
        (OVER | {"episode_reward": 3.0}, "over"),
        ({"truncated": True}, "time"),
        ({"truncated": True, "succeeded": True}, "goal"),
    ],
)
def test_alone(ended: dict[str, Any], word: str) -> None:
    whole = picture("box_chase", {})
    agent = whole.agents[0]._replace(**ended)
    assert end_of(replace(whole, agents=(agent,)), agent) == word


def test_positive_reward_counts_as_goal_without_a_success_term() -> None:
    whole = picture("box_chase", {})
    nameless = replace(whole, static_scene=replace(whole.static_scene, success=""))
    agent = whole.agents[0]._replace(terminated=True, episode_reward=3.0)
    assert end_of(replace(nameless, agents=(agent,)), agent) == "goal"


def test_one_wins_and_the_others_lose() -> None:
    won = OVER | {"succeeded": True}
    assert outcomes("sumo", blue=won | {"fell": True}, orange=OVER | {"fell": True}) == {
        "blue": "won",
        "orange": "lost",
    }
    tie = {"truncated": True}
    assert outcomes("sumo", blue=tie, orange=tie) == {"blue": "time", "orange": "time"}


def test_caught_runner_loses_while_others_continue() -> None:
    caught = OVER | {"reward": -10.0, "episode_reward": 3.0}
    words = outcomes("tag", runner_1=caught)
    assert words == {"chaser": "", "runner_1": "lost", "runner_2": "", "runner_3": ""}


def test_a_runner_that_is_caught_did_not_fall() -> None:
    sim = sim_of("tag")
    chaser, runner = sim.agent("chaser"), sim.agent("runner_1")
    chaser.keyboard.timeout_s = math.inf
    x, y = chaser.body.position
    sim.world["runner 1"].move_to(x + 1.0, y)
    for _ in range(60):
        if runner.done:
            break
        chaser.keyboard.hold({"KeyW"})
        sim.world["chaser"].move_to(*chaser.body.position, heading=0.0)
        sim.step(chaser)
    assert runner.terminated
    assert runner.body.fallen
    whole = capture_snapshot(sim)
    caught = next(agent for agent in whole.agents if agent.id == "runner_1")
    assert not caught.fell
    assert end_of(whole, caught) == "lost"


def test_agent_that_leaves_the_world_did_not_fall() -> None:
    sim = small_sim()
    sim.world["robot"].leave()
    sim.step()
    (state,) = capture_snapshot(sim).agents
    assert (state.terminated, state.fell) == (True, False)


def test_agent_over_the_edge_fell() -> None:
    sim = sim_of("box_chase")
    (agent,) = sim.agents
    agent.body.move_to(20.0, 0.0)
    while not agent.done:
        sim.step()
    for _ in range(120):
        sim.tick()
    assert capture_snapshot(sim).agents[0].fell


def test_fall_after_a_win_keeps_the_outcome() -> None:
    sim = sim_of("platform")  # there every end is one of two terms, and falling is part of one
    (agent,) = sim.agents
    agent.body.move_to(31.0, -2.0)
    while not agent.done:
        sim.step()
    agent.body.move_to(60.0, 0.0)
    for _ in range(120):
        sim.tick()
    assert agent.body.fallen
    (state,) = capture_snapshot(sim).agents
    assert (state.succeeded, state.fell) == (True, False)


def test_keys_for_what_a_body_cannot_do_are_not_shown() -> None:
    assert "jump" not in usable_keys(sim_of("box_chase").agents[0])
    assert "jump_forward" not in usable_keys(sim_of("sumo").agents[0])
    assert "jump" not in usable_keys(sim_of("yardstick").agents[0])
    assert {"forward", "turn_left", "restart"} <= usable_keys(sim_of("yardstick").agents[0]).keys()
    assert {"jump", "jump_forward"} <= usable_keys(sim_of("jumper").agents[0]).keys()


def test_keys_are_called_what_they_do_in_the_scene() -> None:
    names = {"right": "right", "left": "left", "up": "forward", "down": "jump forward"}
    assert key_labels(sim_of("platform").agents[0]) == names
    assert key_labels(sim_of("grid_world").agents[0]) == {}
    assert key_labels(sim_of("box_chase").agents[0]) == {}
