"""A RemoteBrain's decisions from what its link answers."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    Command,
    LocalBrain,
    RemoteBrain,
)
from ai4u_edu.base.errors import ParameterError, SetupError
from ai4u_edu.blocks.brains.links.link import (
    ResetRequest,
)
from tests.blocks.scripted_link import FORWARD, ScriptedLink, sim_with_link


def test_an_action_is_carried_out_and_the_next_situation_is_told() -> None:
    link = ScriptedLink(FORWARD, FORWARD)
    sim, brain = sim_with_link(link)
    for _ in range(2):
        sim.tick()
    assert [each.number for each in link.told] == [1, 2, 3]
    assert [each.steps for each in link.told] == [0, 1, 2]
    assert link.told[1].percept is not link.told[0].percept
    assert brain.status().decisions == 2


def test_who_drives_in_its_place_decides_and_its_answers_are_counted() -> None:
    back = {"move": [-1, 0, 0, 0]}
    link = ScriptedLink(FORWARD, FORWARD, None, Command.STOP, ResetRequest(7), FORWARD)
    sim, brain = sim_with_link(link)
    sim.tick()
    brain.begin_override(LocalBrain(controller=lambda _: back))
    for _ in range(3):
        sim.tick()
        assert sim.agents[0].last_action["move"][0] == -1
        assert not sim.waiting_for_brain  # nobody waits for it
    assert [each.steps for each in link.told] == [0, 1, 2, 3, 4]
    assert link.timeouts[1:] == [0.0] * 3
    assert (brain.status().ignored, brain.status().decisions) == (2, 1)
    assert brain.status().state == "connected"
    sim.tick()  # a reset is not an action
    assert (sim.episode, sim.world.seeds.seed) == (2, 7)
    brain.end_override()
    sim.tick()
    assert sim.agents[0].last_action["move"][0] == 1


def test_a_person_who_restarts_asks_for_no_seed_of_the_scripts() -> None:
    link = ScriptedLink(ResetRequest(7))
    sim, brain = sim_with_link(link)
    sim.tick()
    assert brain.restart_seed() == 7
    brain.begin_override(LocalBrain(controller=lambda _: Command.RESTART))
    sim.tick()
    assert sim.episode == 3
    assert sim.world.seeds.seed != 7


def test_a_reset_with_a_seed_is_the_worlds() -> None:
    link = ScriptedLink(ResetRequest(seed=77), FORWARD)
    sim, _ = sim_with_link(link)
    sim.tick()
    assert (sim.world.seeds.seed, sim.episode) == (77, 2)
    sim.tick()
    assert link.told[-1].truncated is False  # it asked for it itself


def test_somebody_elses_reset_is_told_as_a_cut() -> None:
    link = ScriptedLink(FORWARD, None)
    sim, _ = sim_with_link(link)
    for _ in range(2):
        sim.tick()
    sim.reset()
    sim.tick()
    last = link.told[-1]
    assert (last.done, last.truncated, last.reward, last.steps) == (True, True, 0.0, 1)
    link.answers.append(ResetRequest())
    sim.tick()
    sim.tick()
    assert (link.told[-1].done, link.told[-1].steps) == (False, 0)


@pytest.mark.parametrize(
    ("numbers", "says"),
    [
        ([1, 0], "expected 4 numbers, got 2"),
        ([math.nan, 0, 0, 0], "expected finite numbers"),
        ([math.inf, 0, 0, 0], "expected finite numbers"),
        ("fast", "expected 4 numbers, got 'fast'"),
        (None, "expected 4 numbers, got None"),
    ],
)
def test_a_wrong_action_never_reaches_the_physics(numbers: Any, says: str) -> None:
    link = ScriptedLink({"move": numbers})
    sim, brain = sim_with_link(link, on_missing="coast")
    sim.tick()
    assert sim.agents[0].last_action == {}
    assert says in link.refused[0]
    assert (brain.status().refused, brain.status().decisions) == (1, 0)


def test_where_the_transport_can_say_so_the_script_answers_again() -> None:
    link = ScriptedLink({"mvoe": [1]}, FORWARD)
    link.may_try_again = True
    sim, brain = sim_with_link(link)
    sim.tick()
    assert sim.waiting_for_brain
    assert link.refused == ["agent '0' has no actuator 'mvoe'; did you mean 'move'?"]
    sim.tick()
    assert [each.number for each in link.told] == [1, 2]  # 1 was not told twice
    assert (brain.status().decisions, brain.status().missing) == (1, 0)


def test_numbers_out_of_range_are_cut_and_counted_once() -> None:
    sim, brain = sim_with_link(ScriptedLink({"move": [7, 0, -3, 0]}))
    sim.tick()
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert brain.status().clipped == sim.agents[0].actuators[0].clipped == 2


def test_stop_is_a_matter_of_the_brain_so_that_a_reset_is_still_heard() -> None:
    link = ScriptedLink(Command.STOP, FORWARD, ResetRequest(), FORWARD)
    sim, _ = sim_with_link(link)
    for _ in range(2):
        sim.tick()
    assert (sim.agents[0].steps, link.told[1].stopped) == (0, True)
    for _ in range(2):
        sim.tick()
    assert (sim.agents[0].steps, link.told[-1].stopped) == (1, False)


def test_another_brain_closes_it_and_it_can_be_opened_again() -> None:
    link = ScriptedLink(FORWARD)
    sim, brain = sim_with_link(link)
    agent = sim.agents[0]
    agent.use_brain(RemoteBrain.with_link(ScriptedLink()))
    assert link.closed
    with pytest.raises(SetupError, match=r"was closed; expected agent.use_brain"):
        brain.decide(agent.percept)
    agent.use_brain(brain)
    sim.tick()
    assert brain.status().decisions == 1


def test_an_idle_world_keeps_in_touch() -> None:
    link = ScriptedLink()
    _, brain = sim_with_link(link)
    brain.idle()
    assert link.idled == 1


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"receive_timeout": 100}, "receive_timeout: expected at least 200, got 100"),
        ({"port": 0}, "port: expected at least 1, got 0"),
        ({"mode": "fast"}, "mode: expected 'lockstep' or 'realtime', got 'fast'"),
    ],
)
def test_wrong_parameters(fields: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        RemoteBrain(**fields)
