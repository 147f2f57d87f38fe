"""The strip of a decision's parts: sense, decide, act, reward."""

import re
from dataclasses import replace

import pytest

from ai4u_edu.agent.decision_cycle import Phase
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.viewer.panel.decision import MAX_TICKS, decision
from tests.builders import small_sim


def strip(runner: Runner, phase: Phase, *, paused: bool = True, speed: float = 1.0) -> str:
    snapshot = replace(runner.latest, paused=paused, time_scale=speed)
    return decision(snapshot.agents[0]._replace(phase=phase), snapshot)


def ticks(html: str) -> list[str]:
    """The classes of each tick."""
    return re.findall(r"<em(?: class=\"(.*?)\")?></em>", html)


def marked(html: str) -> list[str]:
    """The parts of the strip where the agent is now."""
    return re.findall(r'<span class="[a-z]* ?now">(\w+)', html)


def test_the_present_tick_is_marked_among_those_of_the_decision(runner: Runner) -> None:
    html = strip(runner, Phase(2, 5, True))
    assert ticks(html) == ["done", "done now", "", "", ""]
    assert marked(html) == ["act"]
    assert "Tick 2 of 5" in html


def test_at_its_end_it_is_rewarded_and_senses_anew(runner: Runner) -> None:
    html = strip(runner, Phase(5, 5, True))
    assert marked(html) == ["sense", "reward"]
    assert "Rewarded, and sensed: decides next." in html
    assert marked(strip(runner, Phase(0, 5, True))) == ["sense"]


def test_an_action_that_is_not_repeated_acts_at_the_first_tick_only(runner: Runner) -> None:
    html = strip(runner, Phase(1, 3, False))
    assert ticks(html) == ["done now", "coasts", "coasts"]
    assert "acts at the first only" in html


@pytest.mark.parametrize(("speed", "visible"), [(0.1, True), (0.25, True), (0.5, False)])
def test_only_what_is_slow_can_be_followed(runner: Runner, speed: float, visible: bool) -> None:
    html = strip(runner, Phase(2, 5, True), paused=False, speed=speed)
    assert bool(marked(html)) is visible
    assert ("Slow down" in html) is not visible


def test_long_decisions_are_drawn_in_part(runner: Runner) -> None:
    html = strip(runner, Phase(0, 100, True))
    assert len(ticks(html)) == MAX_TICKS
    assert "100" in html


@pytest.mark.parametrize("repeats", [True, False])
def test_a_snapshot_knows_how_far_each_agent_is(repeats: bool) -> None:
    sim = small_sim(skip_frame=3)
    sim.agents[0].brain.repeat_action = repeats
    sim.reset(1)
    seen = [capture_snapshot(sim).agents[0].phase]
    for _ in range(6):
        sim.tick()
        seen.append(capture_snapshot(sim).agents[0].phase)
    assert seen == [Phase(tick, 4, repeats) for tick in (0, 1, 2, 3, 4, 1, 2)]
