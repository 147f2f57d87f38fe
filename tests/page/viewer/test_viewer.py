import re
import threading
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from threading import Semaphore
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BoxShape
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.bodies import Bodies
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, Stages
from tests.page.viewer.pages import page, part_of, publish, shown
from tests.page.viewer.worlds import busy_sim
from tests.waiting import LIMIT_S, until


def nodes(viewer: Viewer) -> list[str]:
    """The names of the scene's nodes, without the number of the turn in which they were built."""
    return sorted(viewer.server.scene._handle_from_node_name)


def buffered(viewer: Viewer) -> Counter[str]:
    """Return the buffered messages that a new page receives, counted by type."""
    buffer = viewer.server._websock_server._broadcast_buffer
    return Counter(type(message).__name__ for message in buffer.message_from_id.values())


def pushed(viewer: Viewer) -> int:
    """Return the number of messages sent to all pages so far."""
    return viewer.server._websock_server._broadcast_buffer.message_counter


def test_the_scene_is_complete_before_anybody_watches(viewer: Viewer) -> None:
    names = nodes(viewer)
    for expected in (
        "/ground1/floor plate/top",
        "/ground1/floor ring/side",
        "/ground1/area goal/fill",
        "/ground1/lines",
        "/bodies1/0/body",
        "/bodies1/0/face",
        "/bodies1/0/base",
        "/bodies1/0/pupils",
        "/bodies1/0/treads",
        "/bodies1/0 shadow/shadow",
        "/bodies1/1/rings",
        "/bodies1/0/action",
        "/labels1/0",
    ):
        assert expected in names


def test_bodies_that_look_alike_share_a_batch(viewer: Viewer) -> None:
    twins: Any = viewer.server.scene.get_handle_by_name("/bodies1/2/body")
    assert twins.batched_positions[:, :2].tolist() == [[-3.0, -1.0], [-3.0, 1.0]]
    assert twins.batched_colors[0].tolist() != twins.batched_colors[1].tolist()


def test_wheels_roll_ahead_and_pupils_turn_to_the_target(viewer: Viewer, runner: Runner) -> None:
    scene = viewer.server.scene
    treads: Any = scene.get_handle_by_name("/bodies1/0/treads")
    eyes: Any = scene.get_handle_by_name("/bodies1/0/pupils")
    ahead = eyes.position.tolist()
    assert treads.batched_wxyzs.tolist() == [[1, 0, 0, 0]] * 2
    assert ahead == pytest.approx([0.04, 0, 0], abs=2e-4)  # the box is right ahead of the robot
    robot = runner.sim.agents[0].body
    robot.move_to(0.05, 0.0)
    publish(runner)
    shown(viewer)
    rolled = 2 * np.arcsin(treads.batched_wxyzs[:, 2])  # the top of a wheel moves ahead
    assert rolled == pytest.approx(0.05 / (0.42 * 0.4), rel=0.01)
    robot.move_to(0.05, 0.0, heading=-np.pi / 2)
    publish(runner)
    shown(viewer)
    left, right = 2 * np.arcsin(treads.batched_wxyzs[:, 2]) - rolled
    assert left > 0 > right
    assert eyes.position.tolist() == pytest.approx([0, 0.04, 0], abs=2e-4)


def test_wheels_and_pupils_of_a_robot_that_fell_vanish_with_it(
    viewer: Viewer, runner: Runner
) -> None:
    robot, *others = runner.latest.bodies
    fallen = robot._replace(x=50.0, z=-3.0, on_ground=False, fallen=True)
    bodies = part_of(viewer, Bodies)
    bodies.draw(replace(runner.latest, bodies=(fallen, *others)))
    scene = viewer.server.scene
    for part in ("body", "treads", "pupils"):
        drawn: Any = scene.get_handle_by_name(f"/bodies1/0/{part}")
        assert not drawn.batched_scales.any(), part
    bodies.draw(runner.latest)
    treads: Any = scene.get_handle_by_name("/bodies1/0/treads")
    assert treads.batched_scales.all()


def test_only_what_changed_is_sent(viewer: Viewer, runner: Runner) -> None:
    before = pushed(viewer)
    for part in viewer.parts:
        part.make_due()
        part.draw(runner.latest)
    assert pushed(viewer) == before


def test_messages_kept_for_later_pages_do_not_grow(viewer: Viewer) -> None:
    sim = busy_sim(controller=lambda _percept: {"move": [0.5, 0.3, 0.0, 0.0]})
    runner = Runner(sim, seed=1)

    def play() -> int:
        for _ in range(30):
            runner._tick()
            for part in viewer.parts:
                part.make_due()
            viewer.draw(runner.latest)
        return sum(buffered(viewer).values())

    play()
    assert play() == play()


def test_a_changed_stage_is_built_anew_and_the_old_one_goes(viewer: Viewer, runner: Runner) -> None:
    kept = [name for name in nodes(viewer) if name.startswith("/ground")]
    world = runner.sim.world
    world.add_body("late", BoxShape(size=(1, 2)), position=(-3, 3), label="late")
    publish(runner)
    viewer.draw(runner.latest)
    names = nodes(viewer)
    assert "/bodies2/0/body" not in names  # two names are used by turns
    assert not [name for name in names if name.startswith(("/bodies1", "/labels1"))]
    assert len([name for name in names if re.fullmatch(r"/labels0/\d+", name)]) == 3
    assert [name for name in names if name.startswith("/ground")] == kept


def test_an_area_whose_label_is_blank_has_no_label(viewer: Viewer, runner: Runner) -> None:
    for name, label in (("quiet", " "), ("nameless", "")):
        shape = BoxShape(size=(1, 1))
        runner.sim.world.add_area(name, shape, position=(-3, -3), label=label)
    publish(runner)
    viewer.draw(runner.latest)
    found = [name.split("/area ")[1] for name in nodes(viewer) if "/area " in name]
    assert "quiet/fill" in found
    assert "quiet/label" not in found
    assert "nameless/label" in found  # its name is written


def test_paint_is_opaque_and_has_neither_outline_nor_label(viewer: Viewer, runner: Runner) -> None:
    before: Any = viewer.server.scene.get_handle_by_name("/ground1/lines")
    strokes = len(before.points)
    shape = BoxShape(size=(1, 1))
    runner.sim.world.add_area("line", shape, position=(-3, -3), paint=True, label="unseen")
    publish(runner)
    viewer.draw(runner.latest)
    scene = viewer.server.scene
    fill: Any = scene.get_handle_by_name("/ground0/area line/fill")
    goal: Any = scene.get_handle_by_name("/ground0/area goal/fill")
    lines: Any = scene.get_handle_by_name("/ground0/lines")
    assert (fill.opacity, goal.opacity) == (None, 0.28)
    assert "/ground0/area line/label" not in nodes(viewer)
    assert len(lines.points) == strokes


def test_an_area_that_was_passed_is_filled_until_a_new_start(
    viewer: Viewer, runner: Runner
) -> None:
    fill: Any = viewer.server.scene.get_handle_by_name("/ground1/area goal/fill")
    names = ("goal", "box")
    for passed, ahead, opacity in ((0, names, 0.28), (1, names[1:], 0.7), (0, names, 0.28)):
        stages = (Stages(passed, 2, names, ahead, ahead[:1]),)
        agent = runner.latest.agents[0]._replace(stages=stages)
        for part in viewer.parts:
            part.make_due()
        viewer.draw(replace(runner.latest, agents=(agent,)))
        assert fill.opacity == opacity


def test_a_reset_builds_nothing_anew(viewer: Viewer, runner: Runner) -> None:
    before = nodes(viewer)
    runner.sim.reset(2)
    publish(runner)
    viewer.draw(runner.latest)
    assert nodes(viewer) == before


def test_an_error_is_told_once_and_drawing_goes_on(
    viewer: Viewer,
    runner: Runner,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    drawn = threading.Event()

    def fail(_self: Bodies, snapshot: Snapshot) -> None:
        if snapshot.tick > 3:
            drawn.set()
        raise ValueError(f"no bodies at tick {snapshot.tick}")

    monkeypatch.setattr(Bodies, "draw", fail)
    runner.start()
    viewer.start()
    with page(viewer):
        for _ in range(2):  # the first one is written before it draws again
            assert drawn.wait(LIMIT_S)
            drawn.clear()
    viewer.stop()
    told = capsys.readouterr().err
    assert told.count("ValueError: no bodies at tick") == 1
    assert told.count("Traceback") == 1


def test_an_error_beside_the_parts_does_not_end_the_thread(
    viewer: Viewer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    failed = threading.Event()

    def fail() -> None:
        failed.set()
        raise OSError("no clients")

    monkeypatch.setattr(viewer.viewer_clients, "refresh", fail)
    viewer.start()
    assert failed.wait(LIMIT_S)
    failed.clear()
    assert failed.wait(LIMIT_S)
    viewer.stop()
    assert capsys.readouterr().err.count("OSError: no clients") == 1


@pytest.fixture
def moving() -> Iterator[Viewer]:
    """A viewer of a world in which a body moves."""
    sim = busy_sim(controller=lambda _percept: {"move": [0.5, 0.3, 0.0, 0.0]})
    runner = Runner(sim, seed=1)
    viewer = Viewer(runner)
    yield viewer
    viewer.stop()
    runner.stop(LIMIT_S)


def test_while_nobody_watches_nothing_is_sent(
    moving: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    viewer, runner = moving, moving.runner
    turns, refresh = Semaphore(0), viewer.viewer_clients.refresh

    def refreshed() -> None:
        turns.release()
        refresh()

    def take_turns() -> None:
        """Wait until the viewer's thread has begun and ended a turn."""
        for _ in range(2):
            assert turns.acquire(timeout=LIMIT_S)

    monkeypatch.setattr(viewer.viewer_clients, "refresh", refreshed)
    runner.start()
    viewer.start()
    take_turns()
    before, tick = pushed(viewer), runner.latest.tick
    until(lambda: runner.latest.tick > tick)
    while turns.acquire(blocking=False):
        pass
    take_turns()
    assert pushed(viewer) == before


def test_pages_come_and_go(viewer: Viewer, runner: Runner) -> None:
    runner.start()
    viewer.start()
    for _ in range(3):
        with page(viewer) as first, page(viewer) as second:
            until(lambda: len(viewer.viewer_clients) == 2)
            until(lambda: min(first.received, second.received) > 1000)
        until(lambda: not viewer.viewer_clients)
        assert not viewer.server.get_clients()


def test_a_viewer_that_was_never_started_can_be_stopped(runner: Runner) -> None:
    Viewer(runner).stop()
