"""Drawing of a runner's world in browsers, with viser, from snapshots."""

import threading
import time
from collections.abc import Iterable, Sequence

from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.backend.part import Part, RatedPart
from ai4u_edu.page.viewer.scene.actions import Actions
from ai4u_edu.page.viewer.scene.arena import camera_bounds
from ai4u_edu.page.viewer.scene.bodies import Bodies, RobotMotion
from ai4u_edu.page.viewer.scene.framing import FIELD_OF_VIEW_RAD, frame_arena
from ai4u_edu.page.viewer.scene.ghost_bodies import GhostBodies
from ai4u_edu.page.viewer.scene.ground import (
    INK_PICTURES_PER_S,
    DrawnGround,
    DrawnInk,
    DrawnPictures,
)
from ai4u_edu.page.viewer.scene.handles import PageHandles
from ai4u_edu.page.viewer.scene.labels import Labels, SpeechBubbles
from ai4u_edu.page.viewer.scene.light import set_up_lights
from ai4u_edu.page.viewer.scene.sense_overlay import PictureOption, SenseOverlay
from ai4u_edu.page.viewer.scene.trails import Trails
from ai4u_edu.page.viewer.scene.view import View
from ai4u_edu.page.viewer.viewer_client import ViewerClients
from ai4u_edu.recording import Ghosts
from ai4u_edu.runtime.frame_budget import MAX_FRAMES_PER_S, TEXTS_PER_S
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, StaticScene

MAX_PLOTTED_DECISIONS = 240
"""Decisions of an agent whose rewards the panel plots."""
PAGE_POLL_S = 0.1
"""Poll interval for pages that open, while there are none."""
OPENING_FRAME_S = 1 / 40
"""Longest time between two frames while the camera of a page moves, also if the world waits."""
MIN_PAUSE_S = 0.001
"""Pause after a frame that took longer than it may, so that other threads run."""


class Viewer:
    """The pages on which a runner's world is shown and controlled.

    It holds no state of the world: its thread draws the latest snapshot, and what users ask for
    goes to the runner as commands. While no page is open, it draws new static scenes only.

    Args:
        runner: whose world is drawn.
        title: of viser's page.
        editor: changes the world; without it nothing can be moved with the mouse.
        ghosts: recorded episodes to draw beside the agents; default: none.
        options: draw what they add.
    """

    def __init__(
        self,
        runner: Runner,
        *,
        title: str = "AI4U Edu",
        editor: SceneEditor | None = None,
        ghosts: Ghosts | None = None,
        options: Sequence[PictureOption] = (),
    ) -> None:
        self.runner = runner
        self.server = server = LocalServer(title)
        self.viewer_clients = viewer_clients = ViewerClients(
            server, first=runner.sim.agents[0].id, is_smooth=runner.frame_budget.is_smooth
        )
        self._static_scene: StaticScene | None = None
        self._camera_time = 0.0
        """Processor time (s) for which the cameras were moved for the latest frame."""
        self._error_log = ErrorLog()
        self._stopping = threading.Event()
        self.thread = threading.Thread(target=self._run, name="viewer", daemon=True)
        server.gui.configure_theme(show_logo=False, show_share_button=False)
        set_up_lights(server.scene)
        senses_per_s = runner.frame_budget.senses_per_s
        bodies = Bodies(server, self._choose, lambda: viewer_clients.is_motion_reduced)
        parts: list[tuple[Part, float]] = [
            (viewer_clients, MAX_FRAMES_PER_S),
            (DrawnGround(server), TEXTS_PER_S),
            (DrawnPictures(server), TEXTS_PER_S),
            (DrawnInk(server), INK_PICTURES_PER_S),
            (bodies, MAX_FRAMES_PER_S),
            (Labels(server, viewer_clients), MAX_FRAMES_PER_S),
            (SpeechBubbles(server), TEXTS_PER_S),
            (GhostBodies(server, ghosts or Ghosts()), senses_per_s),
            (RobotMotion(bodies), senses_per_s / 2),  # enough for wheels
            (Actions(server, bodies), senses_per_s),
            (Trails(viewer_clients), senses_per_s),
        ]
        for option in options:
            parts += option.picture_parts(viewer_clients)
        parts.append((SenseOverlay(viewer_clients, senses_per_s, options), MAX_FRAMES_PER_S))
        if editor is not None:
            parts.append((PageHandles(viewer_clients, editor), MAX_FRAMES_PER_S))
        self.parts = [RatedPart(part, rate, self._error_log) for part, rate in parts]
        self.draw(runner.latest)

    @property
    def port(self) -> int:
        """Port on 127.0.0.1 at which viser listens."""
        return self.server.get_port()

    def start(self) -> None:
        """Start to draw."""
        self.thread.start()

    def stop(self) -> None:
        """End the thread and viser's server."""
        self._stopping.set()
        if self.thread.is_alive():
            self.thread.join()
        self.server.stop()

    def _run(self) -> None:
        seen, due = self.runner.latest, time.monotonic()
        while not self._stopping.is_set():
            is_opening = self.viewer_clients.is_opening
            seen = self.runner.wait(seen, OPENING_FRAME_S if is_opening else PAGE_POLL_S)
            if (rest := due - time.monotonic()) > 0:
                self._stopping.wait(rest)
                seen = self.runner.latest
            began, processor_began = time.monotonic(), time.thread_time()
            with self._error_log.caught():
                self.viewer_clients.refresh()
                if self.viewer_clients or seen.static_scene is not self._static_scene:
                    self.draw(seen)
            period = PAGE_POLL_S
            if self.viewer_clients:
                period = self.runner.frame_budget.frame_period(
                    pages=len(self.viewer_clients),
                    tick_lateness=self.runner.lateness,
                    draw_time=time.thread_time() - processor_began + self._camera_time,
                )
            due = max(due + period, began)  # a late frame does not move the later ones
            if time.monotonic() >= due:
                self._stopping.wait(MIN_PAUSE_S)

    def _choose(self, client_id: int, body: str) -> None:
        """Show the agent with that body on one page."""
        viewer_client, static_scene = self.viewer_clients.get(client_id), self._static_scene
        if viewer_client is not None and static_scene is not None and body in static_scene.agent_of:
            viewer_client.agent = static_scene.agent_of[body]
            if viewer_client.panel is not None:
                viewer_client.panel.on_selected(body)

    def draw(self, snapshot: Snapshot) -> None:
        """Draw what is due of a snapshot; the viewer's thread does, once it has started."""
        for agent in self.runner.sim.agents:
            agent.ledger.keep_history(MAX_PLOTTED_DECISIONS)
        with self.server.atomic():
            if snapshot.static_scene is not self._static_scene:
                self._static_scene = snapshot.static_scene
                self._aim(snapshot.static_scene)
                for part in self.parts:
                    part.build(snapshot.static_scene)
            for part in self.parts:
                part.draw(snapshot)
        shown = [(each.view, each.agent) for each in self.viewer_clients.values()]
        if shown:
            loop = self.server.get_event_loop()
            loop.call_soon_threadsafe(self._move_cameras, snapshot, shown)

    def _move_cameras(self, snapshot: Snapshot, shown: Iterable[tuple[View, str]]) -> None:
        """Move the cameras of pages, in the event loop, which takes their reports.

        A report that came between two assignments would have viser leave out the second one if it
        equals the report, and the page would be left with the first one.

        Args:
            snapshot: what is shown.
            shown: camera of each page, and id of the agent that the page shows.
        """
        began = time.thread_time()
        for view, agent in shown:
            with self._error_log.caught():
                view.update(snapshot, agent)
        self._camera_time = time.thread_time() - began

    def _aim(self, static_scene: StaticScene) -> None:
        """Aim the initial camera of new pages, until the shape of their window is known."""
        first, camera = (
            frame_arena(camera_bounds(static_scene), aspect=1.2),
            self.server.initial_camera,
        )
        camera.position = (first.x, first.y, first.distance)
        camera.look_at = (first.x, first.y, 0.0)
        camera.up = (0.0, 1.0, 0.0)
        camera.fov = FIELD_OF_VIEW_RAD
        camera.near, camera.far = first.near, first.far
