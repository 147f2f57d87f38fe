"""Pages in browsers, each with the agent and the sensors that its user has chosen to see."""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future
from typing import Literal, Protocol
from urllib.parse import unquote

from viser import ClientHandle, InitialCameraConfig

from ai4u_edu.page.editing import ChangeResult
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.scene.framing import ground_at_center, ground_matrix
from ai4u_edu.page.viewer.scene.view import Mode, Opening, View
from ai4u_edu.snapshot import Snapshot, StaticScene

AGENT_HEADER = "X-AI4U-Edu-Agent"
"""Request header from our proxy: id of the agent that a page is about, percent-encoded."""
PAGE_HEADER = "X-AI4U-Edu-Page"
"""Request header from our proxy: address of the page in the browser."""
PAGE_ID_HEADER = "X-AI4U-Edu-Page-Id"
"""Request header from our proxy: the page's random id; empty for a page with viser's panel."""
DARK_HEADER = "X-AI4U-Edu-Dark"
"""Request header from our proxy: not empty for a dark page."""


class PagePanel(Protocol):
    """The panel of a page, notified of what its user does in the picture; in viser's loop."""

    def on_selected(self, body: str) -> None:
        """Note that somebody clicked on a body."""

    def on_dropped(self, change: "Future[ChangeResult]") -> None:
        """Report the result of a move with the mouse."""

    def send(self, message: Mapping[str, object]) -> None:
        """Send the page a message."""


class ViewerClient:
    """One page, and what its user has chosen to see there; other pages have choices of their own.

    Args:
        client: the page.
        asked: id of the agent that the page is about; empty if it is about none.
        address: of the page in the browser; empty if it is not known.
        page_id: the page's random id, if its panel is ours; else empty.
        is_dark: True for dark colours.
        is_smooth: True if there are enough pictures a second for a camera that moves.
    """

    def __init__(
        self,
        client: ClientHandle,
        initial_camera: InitialCameraConfig,
        asked: str = "",
        address: str = "",
        page_id: str = "",
        *,
        is_dark: bool = False,
        is_smooth: bool = True,
    ) -> None:
        self.client = client
        self.address = address
        self.page_id = page_id
        self.is_dark = is_dark
        self.panel: PagePanel | None = None
        """Its panel, once that has a connection; None with viser's panel."""
        self.selected = ""
        """Name of the selected thing."""
        self.others: tuple[str, ...] = ()
        """Names of the things that are selected with it."""
        self.is_move_mode = False
        """True if its user may drag things."""
        self.knob_share = 0.025
        """Radius of the handles' knobs, as a share of the picture's height."""
        self.is_motion_reduced = False
        """True if its user prefers pictures without motion that nothing in the world makes."""
        self.choices: dict[str, object] = {}
        """Choices about options, by option; the page's panel has the same."""
        self.snap_m = 0.0
        """Distance (m) of the grid to which dragged things snap; 0 for none."""
        self.view = View(client, initial_camera)
        """Its camera."""
        self._is_smooth = is_smooth
        self.agent = asked
        """Id of the agent that is shown."""
        self.sensor_choices: dict[tuple[str, str], bool] = {}
        """Sensors that were switched on or off, by agent and key."""
        self.trail_choices: dict[str, bool] = {}
        """Trails that were switched on or off, by agent."""

    def settle(self, ids: Sequence[str]) -> None:
        """Show the first of these agents, unless the one that is shown is among them."""
        if self.agent not in ids:
            self.agent = ids[0]

    @property
    def camera(self) -> Literal["arena", "tilted", "follow", "turn", "eyes"]:
        """Position of its camera."""
        return self.view.mode.value

    def choose_camera(self, mode: str) -> None:
        """Put its camera somewhere, also if it was there before and was moved since."""
        self.view.choose(Mode(mode))

    @property
    def opening(self) -> Literal["none", "running", "ending", "over"]:
        """State of the tilt with which it opens."""
        return self.view.opening.value

    def open(self) -> None:
        """Open with a short tilt of the camera, unless its pictures are few."""
        if self._is_smooth:
            self.view.open()
        else:
            self.view.opening = Opening.OVER

    def end_opening(self) -> None:
        """End the tilt."""
        self.view.end_opening()

    @property
    def ground_center(self) -> tuple[float, float]:
        """Point (x, y) of the ground in the middle of its picture (m)."""
        return ground_at_center(self.client.camera.position, self.client.camera.look_at)

    def ground_matrix(self, z: float) -> tuple[float, ...]:
        """Return the map from its picture to the ground at a height, as a matrix row by row."""
        camera = self.client.camera
        aspect = max(camera.image_width, 1) / max(camera.image_height, 1)
        return ground_matrix(camera.position, camera.wxyz, camera.fov, aspect, z)

    def shows_sensor(self, key: str, *, is_default: bool) -> bool:
        """Return True if a sensor of the agent is shown in the scene.

        Args:
            key: the sensor's perception key.
            is_default: True for a sensor that is shown unless the user has switched it off.
        """
        return self.sensor_choices.get((self.agent, key), is_default)

    def set_dark(self, is_dark: bool) -> None:
        """Draw the page's picture in dark or light colours."""
        self.is_dark = is_dark
        self.client.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=is_dark)

    def show_sensor(self, key: str, on: bool, agent: str = "") -> None:
        """Show a sensor in the scene, or hide it; by default one of the agent that is shown."""
        self.sensor_choices[agent or self.agent, key] = on

    def shows_trail(self, agent_id: str, *, is_default: bool) -> bool:
        """Return True if the trail behind an agent is shown.

        Args:
            agent_id: the agent's id.
            is_default: True for an agent whose trail is shown unless the user has switched it off.
        """
        return self.trail_choices.get(agent_id, is_default)

    def show_trail(self, agent_id: str, on: bool) -> None:
        """Show the trail behind an agent on this page, or hide it."""
        self.trail_choices[agent_id] = on


class ViewerClients(Mapping[int, ViewerClient]):
    """All open pages, by viser's client number.

    Args:
        server: viser's.
        first: id of the agent that is shown on pages that are about none in particular.
        is_smooth: True if pages get enough pictures a second for a camera that moves.
    """

    def __init__(self, server: LocalServer, first: str, *, is_smooth: bool = True) -> None:
        self._server = server
        self._is_smooth = is_smooth
        self._first = first
        self._ids: tuple[str, ...] = (first,)
        self._all: dict[int, ViewerClient] = {}

    def __getitem__(self, client_id: int) -> ViewerClient:
        return self._all[client_id]

    def __iter__(self) -> Iterator[int]:
        return iter(tuple(self._all))

    def __len__(self) -> int:
        return len(self._all)

    @property
    def is_motion_reduced(self) -> bool:
        """True if a user of some page prefers reduced motion."""
        return any(each.is_motion_reduced for each in tuple(self._all.values()))

    @property
    def is_opening(self) -> bool:
        """True while the camera of some page moves, whatever the world does."""
        return any(each.view.is_opening for each in tuple(self._all.values()))

    def find(self, page_id: str) -> ViewerClient | None:
        """Return the latest page with a page id; None if there is none."""
        found = [each for each in tuple(self._all.values()) if each.page_id == page_id]
        return found[-1] if found and page_id else None

    def build(self, static_scene: StaticScene) -> None:
        """Take over which agents there are."""
        ids = list(static_scene.agent_of.values())
        self._ids = tuple(sorted(ids, key=lambda each: each != self._first))
        for viewer_client in self._all.values():
            viewer_client.settle(self._ids)

    def draw(self, _snapshot: Snapshot) -> None:
        """Add new pages, before other parts draw for them."""
        self.refresh()

    def refresh(self) -> None:
        """Add pages that were opened, and remove those that were closed."""
        clients = self._server.get_clients()
        for gone in self._all.keys() - clients.keys():
            del self._all[gone]
        for new in sorted(clients.keys() - self._all.keys()):
            asked, address = (
                unquote(self._header(new, AGENT_HEADER)),
                self._header(new, PAGE_HEADER),
            )
            is_dark = bool(self._header(new, DARK_HEADER))
            page_id = self._header(new, PAGE_ID_HEADER)
            viewer_client = ViewerClient(
                clients[new],
                self._server.initial_camera,
                asked,
                address,
                page_id,
                is_dark=is_dark,
                is_smooth=self._is_smooth,
            )
            viewer_client.settle(self._ids)
            if is_dark:
                viewer_client.set_dark(True)
            self._all[new] = viewer_client

    def _header(self, client_id: int, header: str) -> str:
        connection = self._server._websock_server._live_connections.get(client_id)
        request = getattr(connection, "request", None)
        return str(request.headers.get(header, "")) if request is not None else ""
