"""Draws a runner's world on a page, with viser, from snapshots."""

import threading
import time

from ai4u_edu.runner import Runner
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.actions import Actions
from ai4u_edu.viewer.agent_panel import AgentPanel
from ai4u_edu.viewer.bodies import Bodies
from ai4u_edu.viewer.complaints import Complaints
from ai4u_edu.viewer.controls import Controls
from ai4u_edu.viewer.framing import FIELD_OF_VIEW, frame
from ai4u_edu.viewer.ground import Ground
from ai4u_edu.viewer.labels import Labels
from ai4u_edu.viewer.light import light
from ai4u_edu.viewer.local_server import LocalServer
from ai4u_edu.viewer.part import Paced, Part
from ai4u_edu.viewer.placing import seen_bounds
from ai4u_edu.viewer.rays import Rays
from ai4u_edu.viewer.remote_lines import RemoteLines
from ai4u_edu.viewer.spots import Spots
from ai4u_edu.viewer.view import View

PANEL_WIDTH = 320
"""Pixels."""
FRAMES = 60
"""So many pictures a second, if the world ticks as often."""
PAUSE = 0.8 / FRAMES
"""At least so many seconds are between two pictures; less than a tick, so as to miss none."""
IDLE = 0.1
"""Seconds between two looks for somebody who watches, while nobody does."""


class Viewer:
    """The page on which a runner's world can be watched, and asked for things.

    It holds no state of the world: it draws the latest snapshot, and hands on to the runner what
    people ask for. While nobody watches, it draws new stages only.

    Args:
        runner: whose world is drawn.
        title: what the panel is called.
    """

    def __init__(self, runner: Runner, *, title: str = "AI4U Edu") -> None:
        self.runner = runner
        self.server = server = LocalServer(title)
        self._views: dict[int, View] = {}
        self._stage: Stage | None = None
        self._complaints = Complaints()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="viewer", daemon=True)
        server.gui.configure_theme(show_logo=False, show_share_button=False)
        server.gui.main_panel.dock_right()
        server.gui.main_panel.set_width(PANEL_WIDTH)
        light(server.scene)
        panel = AgentPanel(server, first=runner.sim.agents[0].id)
        rays = Rays(server, panel.watched)
        parts: list[tuple[Part, float]] = [
            (Ground(server), 1),
            (Bodies(server, panel.choose), FRAMES),
            (Labels(server), FRAMES),
            (rays, 30),
            (Spots(server, panel.watched), 30),
            (Actions(server), 30),
            (Controls(server, runner, self._views, rays, panel), 8),
            (panel, 8),
            (RemoteLines(server, runner), 2),
        ]
        self._parts = [Paced(part, rate, self._complaints) for part, rate in parts]
        self._draw(runner.latest)

    @property
    def port(self) -> int:
        """Where viser listens, on 127.0.0.1."""
        return self.server.get_port()

    def start(self) -> None:
        """Begins to draw."""
        self._thread.start()

    def stop(self) -> None:
        """Ends the thread and viser's server."""
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join()
        self.server.stop()

    def _run(self) -> None:
        seen = self.runner.latest
        while not self._stopping.is_set():
            seen = self.runner.wait(seen, IDLE)
            began = time.monotonic()
            with self._complaints.caught():
                self._meet_clients()
                if self._views or seen.stage is not self._stage:
                    self._draw(seen)
            spent = time.monotonic() - began
            self._stopping.wait(max((PAUSE if self._views else IDLE) - spent, 0.001))

    def _meet_clients(self) -> None:
        clients = self.server.get_clients()
        for gone in self._views.keys() - clients.keys():
            del self._views[gone]
        for new in clients.keys() - self._views.keys():
            self._views[new] = View(clients[new])

    def _draw(self, snapshot: Snapshot) -> None:
        with self.server.atomic():
            if snapshot.stage is not self._stage:
                self._stage = snapshot.stage
                self._aim(snapshot.stage)
                for part in self._parts:
                    part.build(snapshot.stage)
            for part in self._parts:
                part.draw(snapshot)
        for view in tuple(self._views.values()):
            with self._complaints.caught():
                view.update(snapshot)

    def _aim(self, stage: Stage) -> None:
        """Tells pages that are about to open where to look until their shape is known."""
        first, camera = frame(seen_bounds(stage), aspect=1.2), self.server.initial_camera
        camera.position = (first.x, first.y, first.distance)
        camera.look_at = (first.x, first.y, 0.0)
        camera.up = (0.0, 1.0, 0.0)
        camera.fov = FIELD_OF_VIEW
        camera.near, camera.far = first.near, first.far
