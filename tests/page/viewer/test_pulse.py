"""The target that was reached pulses, and a fall is drawn slowly at first."""

from dataclasses import replace

import pytest

from ai4u_edu.page.viewer.scene.bodies import PULSE_S, SLOW_FALL_S, Pulse, SlowFall, reached_target
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot


def ended(snapshot: Snapshot, x: float, *, succeeded: bool = True) -> Snapshot:
    """Return the end of an episode with the robot at (x, 0); the box is at (3, 0)."""
    agent = snapshot.agents[0]._replace(terminated=True, succeeded=succeeded)
    robot, *others = snapshot.bodies
    return replace(snapshot, agents=(agent,), bodies=(robot._replace(x=x), *others))


def test_the_target_at_the_agent_is_reached_by_success_only(runner: Runner) -> None:
    for x, succeeded, name in ((2.1, True, "box"), (2.1, False, ""), (0.0, True, "")):
        end = ended(runner.latest, x, succeeded=succeeded)
        assert reached_target(end, end.agents[0]) == name
    assert reached_target(runner.latest, runner.latest.agents[0]) == ""


def test_it_pulses_for_a_while_in_each_episode(runner: Runner) -> None:
    now = 5.0
    pulse, end = Pulse(clock=lambda: now), ended(runner.latest, 2.1)
    assert pulse.scales(runner.latest) == {}
    pulse.scales(end)
    now += PULSE_S / 4
    assert pulse.scales(end) == {"box": pytest.approx(1.22)}
    now += PULSE_S
    assert pulse.scales(end) == {"box": 1.0}
    again = replace(end, episode=end.episode + 1)
    pulse.scales(again)
    now += PULSE_S / 4
    assert pulse.scales(again) == {"box": pytest.approx(1.22)}


def test_nothing_pulses_while_motion_is_reduced(runner: Runner) -> None:
    now, is_reduced = 5.0, False
    pulse = Pulse(clock=lambda: now, is_motion_reduced=lambda: is_reduced)
    end = ended(runner.latest, 2.1)
    pulse.scales(end)
    now += PULSE_S / 4
    assert pulse.scales(end)["box"] > 1.0
    is_reduced = True
    assert pulse.scales(end) == {}


def falling(snapshot: Snapshot, z: float) -> Snapshot:
    agent = snapshot.agents[0]._replace(terminated=True, fell=True)
    robot, *others = snapshot.bodies
    return replace(snapshot, agents=(agent,), bodies=(robot._replace(z=z), *others))


def test_a_fall_is_drawn_slowly_at_first_and_catches_up(runner: Runner) -> None:
    now, is_reduced = 5.0, False
    slow = SlowFall(lambda: now, lambda: is_reduced)
    assert slow.drawn(runner.latest) is runner.latest.bodies
    assert slow.drawn(falling(runner.latest, 0.0))[0].z == 0.0
    assert [age for _, age in slow.puffs()] == [0.0]
    now += SLOW_FALL_S / 2
    half = falling(runner.latest, -1.2)
    assert slow.drawn(half)[0].z == pytest.approx(-0.4)
    assert slow.drawn(half)[1:] == runner.latest.bodies[1:]
    is_reduced = True
    assert slow.drawn(half) is half.bodies
    assert slow.puffs() == []
    is_reduced = False
    now += SLOW_FALL_S / 2
    assert slow.drawn(falling(runner.latest, -2.4))[0].z == pytest.approx(-2.4)
    now += 0.1
    assert slow.drawn(falling(runner.latest, -3.0))[0].z == -3.0
    slow.drawn(runner.latest)
    assert slow.puffs() == []  # another episode
