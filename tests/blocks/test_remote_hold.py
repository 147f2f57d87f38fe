"""Holds and calls: a RemoteBrain that stops the time of its world."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    Command,
    LocalBrain,
)
from ai4u_edu.blocks.brains.links.link import (
    ResetRequest,
)
from ai4u_edu.runtime.runner import Runner
from tests.blocks.scripted_link import FORWARD, ScriptedLink, sim_with_link, two_agents
from tests.waiting import LIMIT_S, until


def test_hold_lets_no_time_pass_and_asks_the_same_again() -> None:
    link = ScriptedLink(None, None, FORWARD)
    sim, _ = sim_with_link(link)
    for _ in range(2):
        sim.tick()
        assert sim.waiting_for_brain
    assert sim.world.ticks == 0
    sim.tick()
    assert not sim.waiting_for_brain
    assert sim.world.ticks == 1
    assert [each.steps for each in link.told] == [0, 1]


def test_who_waits_for_a_call_keeps_the_world_waiting() -> None:
    link = ScriptedLink(None, FORWARD)
    sim, brain = sim_with_link(link)
    sim.tick()
    assert (sim.waiting_for_brain, brain.keeps_waiting) == (True, False)  # it has to be asked
    link.will_notify = True
    assert brain.keeps_waiting
    brain.begin_override(LocalBrain(controller=lambda _: {}))
    assert not brain.keeps_waiting
    brain.end_override()
    link.will_notify = False
    sim.tick()
    link.will_notify = True
    assert (sim.waiting_for_brain, brain.keeps_waiting) == (
        False,
        True,
    )  # it was told what it brought
    brain.mode = "realtime"
    assert not brain.keeps_waiting


def test_a_call_ticks_nothing_and_a_world_that_was_called_is_not_asked_again_in_vain(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.pending_answers.ANSWER_POLL_S", LIMIT_S)
    link = ScriptedLink(ResetRequest(7))
    sim, _ = sim_with_link(link)
    runner = Runner(sim, time_scale=math.inf)
    runner.advance()
    runner.advance()
    assert sim.waiting_for_brain
    link.answers.append(FORWARD)
    link.will_notify = True
    link.timeouts.clear()
    runner.expect_answer()
    runner.notify_answer()
    assert sim.world.ticks == 0  # whoever calls has other things to do
    runner.start()
    try:
        until(lambda: sim.world.ticks)
        asked = runner.submit(lambda: (sim.world.ticks, len(link.timeouts)))
        assert asked.result(LIMIT_S) == (1, 1)
    finally:
        runner.stop()


def test_what_the_others_decided_meanwhile_begins_when_the_world_goes_on() -> None:
    asked = []

    def other(percept: Any) -> dict[str, Any]:
        asked.append(sim.world.ticks)
        return FORWARD

    sim = two_agents(ScriptedLink(None, None, {}), other)
    for _ in range(3):
        sim.tick()
    assert asked == [0]  # once, before the world went on
    assert sim.world.ticks == 1
    assert sim.agents[1].body.position[0] > 0


def test_a_restart_of_one_agent_does_not_wait_for_the_world_to_go_on() -> None:
    answers = iter([Command.RESPAWN, FORWARD])
    sim = two_agents(ScriptedLink(None, FORWARD), lambda percept: next(answers))
    sim.tick()
    assert sim.waiting_for_brain
    assert [agent.episode for agent in sim.agents] == [1, 2]
    assert sim.world.ticks == 0


def test_a_held_world_is_a_good_moment_for_a_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.runner.DECISION_WAIT_S", math.inf)
    sim = two_agents(ScriptedLink(), lambda percept: FORWARD)
    runner = Runner(sim, time_scale=math.inf)
    runner.advance()
    assert sim.waiting_for_brain
    command = runner.submit(sim.between_decisions)
    runner.advance()
    assert command.result(0) is False
