"""Late and missing answers of a RemoteBrain, in lockstep and in real time."""

from typing import Any

import pytest

from ai4u_edu.blocks.brains.links.link import (
    LinkState,
    Reply,
    ResetRequest,
)
from ai4u_edu.blocks.brains.remote import YIELD_AFTER_S, YIELDING_WAIT_S
from tests.blocks.scripted_link import FORWARD, ScriptedLink, sim_with_link, two_agents

RECEIVE_TIMEOUT_S = 2.0
"""Default of a brain's ``receive_timeout``."""
MOMENT_S = 0.001


def test_a_script_that_asks_for_time_does_not_stop_the_others_for_long() -> None:
    link = ScriptedLink()
    sim = two_agents(link, lambda percept: FORWARD)
    sim.tick()
    link.clock.advance(YIELD_AFTER_S - MOMENT_S)
    link.ask_for_time()
    sim.tick()
    assert sim.world.ticks == 0
    link.clock.advance(2 * MOMENT_S)
    for _ in range(5):
        link.ask_for_time()
        sim.tick()
    assert [agent.steps for agent in sim.agents] == [0, 1]
    assert link.timeouts[-1] == YIELDING_WAIT_S


def test_a_script_that_asks_for_time_is_waited_for_in_a_world_of_its_own() -> None:
    link = ScriptedLink()
    sim, brain = sim_with_link(link)
    for _ in range(10):
        sim.tick()
        link.clock.advance(RECEIVE_TIMEOUT_S)
        link.ask_for_time()
    assert (sim.world.ticks, brain.status().missing, brain.status().state) == (0, 0, "connected")
    link.clock.advance(RECEIVE_TIMEOUT_S + MOMENT_S)  # it has asked for no more
    sim.tick()
    assert (sim.world.ticks, brain.status().missing, brain.status().state) == (1, 1, "late")


@pytest.mark.parametrize(
    ("on_missing", "action"),
    [("hold", {"move": (1.0, 0.0, 0.0, 0.0)}), ("coast", {}), ("stop", {"move": (0.0,) * 4})],
)
def test_a_lost_script_is_replaced_by_the_policy(on_missing: str, action: dict[str, Any]) -> None:
    link = ScriptedLink(FORWARD)
    sim, brain = sim_with_link(link, on_missing=on_missing)
    sim.tick()
    link.state, link.reason = LinkState.LOST, "gone"
    for _ in range(3):
        sim.tick()
    agent = sim.agents[0]
    assert (agent.steps, agent.last_action) == (4, action)
    status = brain.status()
    assert (status.state, status.reason, status.missing) == ("lost", "gone", 3)


def test_while_it_waits_for_a_script_the_agent_takes_no_decisions() -> None:
    link = ScriptedLink()
    link.state, link.expects_reply = LinkState.WAITING, False
    sim, brain = sim_with_link(link)
    for _ in range(3):
        sim.tick()
    assert (sim.world.ticks, sim.agents[0].steps) == (3, 0)
    assert brain.status().state == "waiting"


def test_a_script_that_is_silent_for_too_long_is_late() -> None:
    link = ScriptedLink()
    # real time: none passes, since the test advances the link's clock
    sim, brain = sim_with_link(link, on_missing="stop")
    sim.tick()
    link.clock.advance(RECEIVE_TIMEOUT_S - MOMENT_S)
    sim.tick()
    assert (sim.world.ticks, brain.status().state) == (0, "connected")
    link.clock.advance(2 * MOMENT_S)
    sim.tick()
    status = brain.status()
    assert (sim.world.ticks, status.state, status.missing) == (1, "late", 1)
    assert status.reason.startswith("no action for 2.0 s")
    link.answers.append(FORWARD)
    sim.tick()
    assert (brain.status().state, brain.status().reason) == ("connected", "")


def silent_sim(link: ScriptedLink, **fields: Any) -> Any:
    """Return a sim and its brain in lockstep whose script has timed out."""
    sim, brain = sim_with_link(link, **fields)
    sim.tick()
    link.clock.advance(RECEIVE_TIMEOUT_S + MOMENT_S)
    sim.tick()
    assert brain.status().state == "late"
    return sim, brain


def test_a_brain_may_get_another_receive_timeout_at_any_time() -> None:
    link = ScriptedLink()
    sim, brain = sim_with_link(link)
    sim.tick()
    brain.receive_timeout = 60_000
    link.clock.advance(60)
    sim.tick()
    assert sim.waiting_for_brain
    brain.receive_timeout = 59_000
    sim.tick()
    assert brain.status().state == "late"


def test_a_script_that_was_given_up_is_not_waited_for() -> None:
    link = ScriptedLink(FORWARD)
    sim, brain = silent_sim(link)
    link.timeouts.clear()
    link.will_notify = True
    for missing in range(2, 30):
        sim.tick()
        assert not sim.waiting_for_brain
        assert not brain.keeps_waiting
        assert brain.status().missing == missing
    assert set(link.timeouts) == {0.0}
    assert "given up, the world goes on until it answers" in brain.status().reason
    sim.reset()
    sim.tick()
    assert not sim.waiting_for_brain  # in another episode neither


@pytest.mark.parametrize("speaks", ["late", "now", "asks for time", "resets"])
def test_a_script_that_was_given_up_is_waited_for_again_once_it_speaks(speaks: str) -> None:
    link = ScriptedLink(FORWARD)
    sim, brain = silent_sim(link)
    sim.tick()
    match speaks:
        case "late":
            link.answers.append(Reply({"move": [0, 1, 0, 0]}, link.told[1]))
        case "now":
            link.answers.append(FORWARD)
        case "resets":
            link.answers.append(ResetRequest())
        case "asks for time":
            link.clock.advance(MOMENT_S)
            link.ask_for_time()
    sim.tick()
    assert sim.agents[0].last_action != {"move": (0.0, 1.0, 0.0, 0.0)}
    sim.tick()
    assert sim.waiting_for_brain
    assert brain.status().state == "connected"
    link.answers.append({"move": [0, 0, 1, 0]})
    sim.tick()
    assert not sim.waiting_for_brain
    assert sim.agents[0].last_action == {"move": (0.0, 0.0, 1.0, 0.0)}


def test_another_script_begins_anew() -> None:
    link = ScriptedLink(FORWARD)
    sim, _ = silent_sim(link)
    link.state = LinkState.LOST
    sim.tick()
    link.state = LinkState.CONNECTED
    sim.tick()
    assert sim.waiting_for_brain


def test_a_late_answer_in_lockstep_is_dropped_and_counted() -> None:
    link = ScriptedLink(FORWARD)
    sim, brain = sim_with_link(link)
    sim.tick()
    link.answers.append(Reply({"move": [0, 1, 0, 0]}, link.told[0]))  # that one is answered
    sim.tick()
    assert sim.waiting_for_brain
    assert brain.status().ignored == 1
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}


def test_in_real_time_nobody_waits_and_a_late_answer_is_for_the_next_decision() -> None:
    link = ScriptedLink(None, None)
    sim, brain = sim_with_link(link, mode="realtime", on_missing="coast")
    for _ in range(2):
        sim.tick()
    assert set(link.timeouts) == {0.0}
    assert (sim.agents[0].steps, brain.status().missing) == (2, 2)
    link.answers.append(Reply(FORWARD, link.told[0]))
    sim.tick()
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    link.answers += [Reply(FORWARD, link.told[0])]
    sim.reset()
    sim.tick()
    assert sim.agents[0].last_action == {}  # it was meant for another episode
    assert brain.status().ignored == 1


def test_in_real_time_a_script_is_told_as_soon_as_the_agent_has_sensed() -> None:
    link = ScriptedLink()
    sim, brain = sim_with_link(link, mode="realtime", skip_frame=1)
    agent = sim.agents[0]
    sim.tick()
    assert [told.steps for told in link.told] == [0]
    sim.tick()
    assert [told.steps for told in link.told] == [0, 1]
    assert link.told[-1].percept is agent.percept
    assert link.told[-1].tick == sim.world.ticks == 2
    link.answers.append(Reply(FORWARD, link.told[-1]))  # in time for the very next tick
    sim.tick()
    assert agent.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    before = len(agent.percept_ready.handlers)
    brain.close()
    assert len(agent.percept_ready.handlers) == before - 1


def test_in_lockstep_a_script_thinks_while_the_world_finishes_its_tick() -> None:
    link = ScriptedLink(FORWARD)
    sim, _ = sim_with_link(link)
    sim.tick()
    assert [told.steps for told in link.told] == [0, 1]
    assert link.told[1].percept is sim.agents[0].percept
