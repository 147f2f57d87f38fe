"""Trails behind agents."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BasicAgent, ControlRequestor, LocalBrain, RBMoveActuator, WASDRBMoveController
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.trails import MAX_DOTS, TRAIL_S, Trail, Trails
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from tests.page.viewer.pages import page, part_of, publish, seen, shown
from tests.page.viewer.worlds import busy_sim, busy_world


def places(snapshot: Snapshot, *steps: tuple[float, float]) -> list[float]:
    """Return the trail after a body was at x = each step's second number at its first (s)."""
    trail, (agent,) = Trail(), snapshot.agents
    for time, x in steps:
        body = snapshot.bodies[0]._replace(x=x, y=0.0, z=0.0, fallen=x > 90)
        trail.record(replace(snapshot, time=time), agent, body)
    return [float(x) for x in trail.places()[:, 0]]


def test_a_trail_goes_back_a_while(runner: Runner) -> None:
    picture = runner.latest
    assert places(picture, (0.0, 0.0), (0.1, 1.0), (0.2, 2.0)) == [2.0, 1.0, 0.0]
    assert places(picture, (0.0, 0.0), (0.01, 1.0), (0.1, 2.0)) == [2.0, 0.0]
    many = [(0.1 * number, float(number)) for number in range(60)]
    assert len(places(picture, *many)) == pytest.approx(MAX_DOTS, abs=1)
    # a body that stands leaves no dots, and the old ones go
    assert places(picture, (0.0, 0.0), (0.1, 1.0), (1.0, 1.0)) == [1.0, 0.0]
    assert places(picture, (0.0, 0.0), (0.1, 1.0), (0.05 + TRAIL_S, 1.0)) == [1.0]


def test_a_trail_ends_with_its_episode_and_at_a_fall(runner: Runner) -> None:
    assert places(runner.latest, (1.0, 1.0), (2.0, 2.0), (0.5, 3.0)) == [3.0]
    assert places(runner.latest, (1.0, 1.0), (2.0, 99.0)) == []


def sim_of(controller: Any) -> ControlRequestor:
    brain = LocalBrain(controller=controller)
    agent = BasicAgent(body="robot", actuators=[RBMoveActuator(move_amount=2)], brains=[brain])
    return ControlRequestor(busy_world(), [agent])


@pytest.mark.parametrize(
    ("controller", "is_default"),
    [(lambda _percept: {"move": [1, 0, 0, 0]}, True), (WASDRBMoveController(), False)],
)
def test_it_is_shown_unless_a_person_drives(
    controller: Callable[[Any], Any] | WASDRBMoveController, is_default: bool
) -> None:
    viewer = Viewer(Runner(sim_of(controller), seed=1))
    try:
        with page(viewer), page(viewer):
            trails = part_of(viewer, Trails)
            seen(viewer, lambda: len(trails.pages) == 2)
            first, second = trails.pages.values()
            assert bool(first.shown) is bool(second.shown) is is_default
            next(iter(viewer.viewer_clients.values())).show_trail("0", not is_default)
            trails._turns._drawn_at.clear()
            seen(viewer, lambda: bool(first.shown) is not is_default)
            assert bool(second.shown) is is_default
    finally:
        viewer.stop()


def test_dots_are_where_the_body_was() -> None:
    runner = Runner(busy_sim(controller=lambda _percept: {"move": [1.0, 0, 0, 0]}), seed=1)
    viewer = Viewer(runner)
    try:
        with page(viewer):
            trails = part_of(viewer, Trails)
            for _ in range(40):
                runner._tick()
                publish(runner)
                trails.draw(runner.latest)
            trails._turns._drawn_at.clear()
            shown(viewer)
            dots: Any = next(iter(trails.pages.values())).dots
            scales = dots.batched_scales
            count = int((scales > 0).sum())
            assert 4 <= count <= 8
            assert (np.diff(scales[:count]) < 0).all()
            along = dots.batched_positions[:count, 0]
            assert along[0] == pytest.approx(runner.sim.agents[0].body.position[0], abs=0.25)
            assert np.diff(along) == pytest.approx(np.full(count - 1, -0.2), abs=0.05)
    finally:
        viewer.stop()
