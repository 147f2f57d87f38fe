"""A tick that takes too long is reported: in the snapshot, on the page, by the API."""

from typing import Any

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
from ai4u_edu.base.errors import WorldError
from ai4u_edu.page.panel.parts.run import slow_warning
from ai4u_edu.page.server.api import SnapshotView
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.tick_monitor import SLOW_TICK_S, SLOW_TICK_SHOWN_S
from tests.builders import small_sim, still


class Clock:
    """Time that passes when a test says so."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def slowed(clock: Clock, times: list[float], **options: Any) -> Runner:
    """A runner whose ticks take so long, one after another; then none."""
    sim = small_sim(**options)

    def take_time(_: BasicAgent) -> None:
        clock.now += times.pop(0) if times else 0.0

    sim.agents[0].end_of_step.connect(take_time)
    sim.agents[0].brain.skip_frame = 0
    return Runner(sim, clock=clock, time_scale=float("inf"))


def told(runner: Runner) -> float | None:
    """Return how long the slowest tick took; None if none is reported."""
    slow = runner.latest.slow_tick
    return None if slow is None else slow.seconds


def test_a_slow_tick_is_remembered_for_a_while_and_the_slowest_counts() -> None:
    clock = Clock()
    runner = slowed(clock, [SLOW_TICK_S, 0.2, 0.1])
    runner.advance()
    assert told(runner) is None  # just quick enough
    runner.advance()
    runner.advance()
    clock.now += 0.1
    runner.advance()
    assert told(runner) == pytest.approx(0.2)
    assert slow_warning(runner.latest) == "Slow computer: a step took 200 ms."
    view = SnapshotView.of(runner.latest).slow_tick
    assert view is not None
    assert view.seconds == pytest.approx(0.2)
    clock.now += SLOW_TICK_SHOWN_S + 0.1
    runner.advance()
    assert told(runner) is None
    assert slow_warning(runner.latest) == ""


def crowd(count: int) -> ControlRequestor:
    """Discs that lie in each other, put there behind the world's back."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), position=(50, 0))
    for number in range(count):
        world.add_body(f"disc{number}", CircleShape(radius=0.5), position=(2.0 * number, 20))
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=still)])
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    for number in range(count):
        world.bodies[f"disc{number}"]._pm.position = (number * 1e-3, 20)
    return sim


def test_contacts_are_counted_and_blamed() -> None:
    clock, sim = Clock(), crowd(40)
    runner = Runner(sim, clock=clock)
    for number in range(40):
        sim.world.bodies[f"disc{number}"]._pm.position = (number * 1e-3, 20)
    tick = sim.world.tick

    def slow_tick() -> None:
        tick()
        clock.now += 0.3

    sim.world.tick = slow_tick  # type: ignore[method-assign]
    runner.advance()
    slow = runner.latest.slow_tick
    assert slow is not None
    assert slow.contacts == 40 * 39 // 2
    assert slow_warning(runner.latest) == (
        "Slow computer: a step took 300 ms with 780 contacts. Move bodies out of each other."
    )


def test_there_is_room_for_500_bodies_and_no_more() -> None:
    world = World()
    for number in range(500):
        world.add_body(f"disc{number}", CircleShape(radius=0.1), position=(number, 0))
    with pytest.raises(WorldError, match="500"):
        world.add_body("one more", CircleShape(radius=0.1), position=(-5, 0))
