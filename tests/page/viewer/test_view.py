import asyncio
import threading
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from viser import CameraHandle

from ai4u_edu import BasicAgent, BoxShape, CircleShape, ControlRequestor, LocalBrain, World
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.arena import camera_bounds
from ai4u_edu.page.viewer.scene.framing import Frame, frame_arena, frame_point, frame_tilted
from ai4u_edu.page.viewer.scene.view import (
    FOLLOW_HEIGHT_IN_RADII,
    OPENING_S,
    OPENING_TILT_RAD,
    Mode,
    Opening,
    View,
)
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from tests.page.viewer.pages import Page, page, shown
from tests.waiting import LIMIT_S, until

PLACE = (1.0, -2.0, 80.0)
"""Somewhere a person might move the camera."""


class Watched:
    """A page, its camera as viser has it, and the view that moves it."""

    def __init__(self, viewer: Viewer, here: Page) -> None:
        (client,) = viewer.server.get_clients().values()
        self.now = 100.0
        self.page, self.client = here, client
        self.loop = viewer.server.get_event_loop()
        self.view = View(client, viewer.server.initial_camera, clock=lambda: self.now)

    @property
    def camera(self) -> CameraHandle:
        return self.client.camera

    def report(self, place: tuple[float, float, float], size: tuple[int, int] = (960, 800)) -> None:
        """The page reports where its camera is."""
        before = self.camera.update_timestamp
        self.page.report_camera(place, size)
        until(lambda: self.camera.update_timestamp > before)
        # the view is told in the same turn of the loop, after the camera has it
        asyncio.run_coroutine_threadsafe(asyncio.sleep(0), self.loop).result(LIMIT_S)

    def sent(self) -> int:
        """The number of messages sent to this page alone."""
        return self.client._websock_connection.get_message_buffer().message_counter


@pytest.fixture
def watched(viewer: Viewer) -> Iterator[Watched]:
    with page(viewer) as here:
        yield Watched(viewer, here)


def whole(snapshot: Snapshot, aspect: float = 1.2) -> Frame:
    return frame_arena(camera_bounds(snapshot.static_scene), aspect)


def place(shown: Frame) -> tuple[float, float, float]:
    return shown.x, shown.y, shown.distance


def middle(x: float, y: float, height: float) -> list[float]:
    """Return the target of a camera that shows a point in the middle of the uncovered window."""
    shown = frame_point(x, y, height, 1.2)
    return [shown.x, shown.y, 0.0]


def with_robot_at(snapshot: Snapshot, x: float, y: float) -> Snapshot:
    first, *others = snapshot.bodies
    return replace(snapshot, bodies=(first._replace(x=x, y=y), *others))


def test_a_page_sees_the_whole_arena_from_above(watched: Watched, runner: Runner) -> None:
    watched.view.update(runner.latest, "0")
    shown, camera = whole(runner.latest), watched.camera
    assert camera.position == pytest.approx(place(shown))
    assert camera.look_at == pytest.approx([shown.x, shown.y, 0.0])
    assert camera.up_direction == pytest.approx([0.0, 1.0, 0.0])
    assert camera.near < shown.distance < camera.far


def test_a_camera_is_left_alone_while_nothing_changes(watched: Watched, runner: Runner) -> None:
    watched.view.update(runner.latest, "0")
    before = watched.sent()
    for _ in range(3):
        watched.view.update(runner.latest, "0")
    assert watched.sent() == before


def test_another_window_is_framed_anew(watched: Watched, runner: Runner) -> None:
    watched.view.update(runner.latest, "0")
    watched.report(place(whole(runner.latest)))
    watched.report(place(whole(runner.latest)), size=(390, 844))
    watched.view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(place(whole(runner.latest, 390 / 844)))


def test_a_camera_that_a_person_moved_is_theirs(watched: Watched, runner: Runner) -> None:
    watched.view.update(runner.latest, "0")
    watched.report(place(whole(runner.latest)))
    watched.report(PLACE)
    watched.report(PLACE, size=(500, 800))
    watched.view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(PLACE)


def test_stale_camera_reports_are_ignored(watched: Watched, runner: Runner) -> None:
    watched.view.update(runner.latest, "0")
    watched.report((3.0, 3.0, 3.0), size=(500, 800))  # from before our message came
    watched.view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(place(whole(runner.latest, 500 / 800)))


def test_no_report_comes_in_the_middle_of_a_move(
    viewer: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A page reports that its camera is where we are about to put it."""
    frame = whole(viewer.runner.latest)
    wanted = pytest.approx([frame.x, frame.y, 0.0])
    loop_threads: list[int] = []
    position_of_camera = vars(CameraHandle)["position"]

    def move(camera: CameraHandle, position: tuple[float, float, float]) -> None:
        position_of_camera.fset(camera, position)
        here.report_camera(position)
        if threading.get_ident() not in loop_threads:  # the loop reads it now
            until(lambda: camera.look_at == wanted)

    with page(viewer) as here:
        viewer.server.get_event_loop().call_soon_threadsafe(
            lambda: loop_threads.append(threading.get_ident())
        )
        until(lambda: loop_threads)
        monkeypatch.setattr(CameraHandle, "position", position_of_camera.setter(move))
        shown(viewer)
        until(lambda: here.look_at == wanted)


@pytest.mark.parametrize("has_arrived", [False, True])
def test_a_page_that_goes_to_its_initial_camera_once_more_is_put_back(
    watched: Watched, runner: Runner, has_arrived: bool
) -> None:
    wide = place(whole(runner.latest, 1.6))
    watched.report((3.0, 3.0, 3.0), size=(1280, 800))
    watched.view.update(runner.latest, "0")
    if has_arrived:
        watched.report(wide, size=(1280, 800))
    watched.report(place(whole(runner.latest)), size=(1280, 800))
    watched.view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(wide)


def test_a_report_that_comes_too_late_is_nobodys_move(watched: Watched, runner: Runner) -> None:
    old, wide = place(whole(runner.latest)), place(whole(runner.latest, 1.6))
    watched.view.update(runner.latest, "0")
    watched.report(old)
    watched.report(old, size=(1280, 800))
    watched.view.update(runner.latest, "0")
    watched.report(wide, size=(1280, 800))
    watched.report(old, size=(1280, 800))
    watched.report(wide, size=(390, 844))
    watched.view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(place(whole(runner.latest, 390 / 844)))


def test_another_arena_is_shown_whole_whoever_moved_the_camera(
    watched: Watched, runner: Runner
) -> None:
    watched.view.update(runner.latest, "0")
    watched.report(place(whole(runner.latest)))
    watched.report(PLACE)
    static_scene = replace(runner.latest.static_scene, bounds=((0.0, 0.0), (40.0, 40.0)))
    other = replace(runner.latest, static_scene=static_scene)
    watched.view.update(other, "0")
    assert watched.camera.position == pytest.approx(place(whole(other)))


def test_a_followed_agent_comes_to_the_middle_smoothly(watched: Watched, runner: Runner) -> None:
    view = watched.view
    view.update(runner.latest, "0")
    view.choose(Mode.FOLLOW)
    view.update(runner.latest, "0")
    assert watched.camera.look_at == pytest.approx(middle(0.0, 0.0, 0.4 * FOLLOW_HEIGHT_IN_RADII))
    assert watched.camera.position[2] == pytest.approx(
        Frame(0, 0, 0.4 * FOLLOW_HEIGHT_IN_RADII).distance
    )
    ways = []
    for _ in range(60):
        watched.now += 1 / 60
        view.update(with_robot_at(runner.latest, 2.0, -1.0), "0")
        ways.append(float(watched.camera.look_at[0]))
    assert np.diff([0.0, *ways]).min() >= 0.0
    assert ways[0] < 0.25
    assert ways[-1] == pytest.approx(2.0, abs=0.02)
    before = watched.sent()
    watched.now += 1.0
    view.update(with_robot_at(runner.latest, ways[-1], -1.0), "0")
    view.update(with_robot_at(runner.latest, ways[-1], -1.0), "0")
    assert watched.sent() - before <= 4  # it has arrived: nothing more is sent


def test_zoom_is_kept_while_following(watched: Watched, runner: Runner) -> None:
    view = watched.view
    view.choose(Mode.FOLLOW)
    view.update(runner.latest, "0")
    watched.report((0.0, 0.0, 60.0))
    view.update(with_robot_at(runner.latest, 2.0, 0.0), "0")
    assert watched.camera.position[2] == pytest.approx(60.0)


def test_following_goes_on_with_the_agent_that_is_looked_at_and_ends(
    watched: Watched, runner: Runner
) -> None:
    (agent,) = runner.latest.agents
    other = agent._replace(id="1", body="box")
    both = replace(runner.latest, agents=(agent, other))
    view = watched.view
    view.choose(Mode.FOLLOW)
    for agent_id, expected in (("0", "robot"), ("1", "box"), ("0", "robot")):
        view.update(both, agent_id)
        body = next(body for body in runner.latest.bodies if body.name == expected)
        height = watched.view.frame.height
        assert watched.camera.look_at == pytest.approx(middle(body.x, body.y, height))
    view.choose(Mode.ARENA)
    view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(place(whole(runner.latest)))


def turned(snapshot: Snapshot, heading: float) -> Snapshot:
    first, *others = snapshot.bodies
    return replace(snapshot, bodies=(first._replace(heading=heading), *others))


def test_a_camera_that_turns_has_ahead_on_top(watched: Watched, runner: Runner) -> None:
    view = watched.view
    view.choose(Mode.TURN)
    for heading, up in ((0.0, (1, 0, 0)), (np.pi / 2, (0, 1, 0)), (np.pi, (-1, 0, 0))):
        view.update(turned(runner.latest, heading), "0")
        assert watched.camera.up_direction == pytest.approx(up, abs=1e-6)
        assert watched.camera.position[2] > 50
    view.choose(Mode.FOLLOW)
    view.update(turned(runner.latest, 1.0), "0")
    assert watched.camera.up_direction == pytest.approx((0, 1, 0))


def test_through_its_eyes_the_camera_is_where_the_rays_begin(
    watched: Watched, runner: Runner
) -> None:
    view = watched.view
    view.choose(Mode.EYES)
    view.update(turned(runner.latest, np.pi / 2), "0")
    origin = runner.latest.agents[0].rays["fan"].origin
    assert watched.camera.position == pytest.approx(origin, abs=0.1)  # as bodies are, a bit higher
    ahead = watched.camera.look_at - watched.camera.position
    assert ahead[:2] == pytest.approx([0, 1], abs=1e-6)
    assert watched.camera.up_direction == pytest.approx((0, 0, 1))
    assert watched.camera.fov > 1
    lamps = [name for name in watched.client.scene._handle_from_node_name if "daylight/" in name]
    assert lamps
    view.choose(Mode.ARENA)
    view.update(runner.latest, "0")
    assert watched.camera.position == pytest.approx(place(whole(runner.latest)))
    assert watched.camera.fov < 0.1
    left = watched.client.scene._handle_from_node_name
    assert not [name for name in left if name in lamps]


def test_a_tilted_camera_sees_the_whole_arena_before_a_sky(
    watched: Watched, runner: Runner
) -> None:
    view, camera = watched.view, watched.camera
    view.choose(Mode.TILTED)
    view.update(runner.latest, "0")
    wanted = frame_tilted(camera_bounds(runner.latest.static_scene), 1.2)
    nodes = watched.client.scene._handle_from_node_name
    assert "/outside/void" in nodes  # below the sky; from above, the page's background is enough
    assert camera.position == pytest.approx(wanted.position)
    assert camera.look_at == pytest.approx(wanted.target)
    assert camera.up_direction == pytest.approx((0, 0, 1))
    assert camera.fov > 0.5
    before = watched.sent()
    view.update(runner.latest, "0")
    assert watched.sent() == before
    watched.report(wanted.position)
    watched.report(PLACE)  # a person moves it
    watched.report(PLACE, size=(500, 800))
    view.update(runner.latest, "0")
    assert camera.position == pytest.approx(PLACE)
    view.choose(Mode.ARENA)
    view.update(runner.latest, "0")
    assert "/outside/void" not in nodes
    assert camera.fov < 0.1
    assert camera.up_direction == pytest.approx((0, 1, 0))


@pytest.mark.parametrize("mode", [Mode.ARENA, Mode.TILTED, Mode.FOLLOW, Mode.EYES])
def test_a_scene_of_another_size_is_shown(watched: Watched, runner: Runner, mode: Mode) -> None:
    view, camera = watched.view, watched.camera
    view.choose(mode)
    for size in (10, 10_000, 0.1, 10_000):
        world = World()
        world.add_floor("plate", BoxShape(size=(size, size)))
        world.add_body("robot", CircleShape(radius=size / 20), tags=("agent",))
        agent = BasicAgent(body="robot", brains=[LocalBrain(controller=lambda _: {})])
        sim = ControlRequestor(world, [agent])
        sim.reset(1)
        view.update(capture_snapshot(sim), "0")
        distance = float(np.linalg.norm(camera.position - camera.look_at))
        if mode is not Mode.EYES:
            assert camera.min_orbit_distance < distance < camera.max_orbit_distance
            assert camera.near < distance < camera.far


def tilt(camera: CameraHandle) -> float:
    """Return the angle (degrees) by which a camera is tilted from looking straight down."""
    x, y, z = camera.position - camera.look_at
    return float(np.degrees(np.arctan2(np.hypot(x, y), z)))


def test_a_page_opens_with_a_tilt_in_the_same_lens(watched: Watched, runner: Runner) -> None:
    view, camera = watched.view, watched.camera
    view.update(runner.latest, "0")
    lens = camera.fov
    view.open()
    tilts = []
    for _ in range(30):
        view.update(runner.latest, "0")
        if view.opening is Opening.RUNNING:
            tilts.append(tilt(camera))
            assert camera.fov == lens
        watched.now += OPENING_S / 24
    assert tilts[0] < 1
    assert max(tilts) == pytest.approx(np.degrees(OPENING_TILT_RAD), abs=1)
    assert tilts[-1] < 2
    assert view.opening is Opening.OVER
    assert camera.position == pytest.approx(place(whole(runner.latest)))
    before = watched.sent()
    view.open()  # once only
    view.update(runner.latest, "0")
    assert watched.sent() == before


def test_the_opening_ends_at_once_for_whoever_does_something(
    watched: Watched, runner: Runner
) -> None:
    view, camera = watched.view, watched.camera
    view.open()
    view.update(runner.latest, "0")
    watched.now += OPENING_S / 2
    view.update(runner.latest, "0")
    assert tilt(camera) > 30
    view.end_opening()
    view.update(runner.latest, "0")
    assert view.opening is Opening.OVER
    assert camera.position == pytest.approx(place(whole(runner.latest)))
    watched.report(place(whole(runner.latest)))
    watched.report(PLACE)  # from then on the camera is theirs
    view.update(runner.latest, "0")
    assert camera.position == pytest.approx(PLACE)


def test_another_camera_ends_the_opening(watched: Watched, runner: Runner) -> None:
    watched.view.open()
    watched.view.update(runner.latest, "0")
    watched.view.choose(Mode.EYES)
    watched.view.update(runner.latest, "0")
    assert watched.view.opening is Opening.OVER
    assert watched.camera.fov > 1
