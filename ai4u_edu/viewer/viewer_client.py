"""Somebody who looks at a page: which agent they look at, and which of its sensors light up."""

from collections.abc import Iterator, Mapping, Sequence
from urllib.parse import unquote

from viser import ClientHandle

from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.scene.view import View

AGENT_HEADER = "X-AI4U-Edu-Agent"
"""By this our proxy tells viser which agent a page is about, percent-encoded."""
PAGE_HEADER = "X-AI4U-Edu-Page"
"""By this our proxy tells viser the address under which a browser has the page."""
DARK_HEADER = "X-AI4U-Edu-Dark"
"""By this our proxy tells viser that a page is to be dark; empty for light."""


class ViewerClient:
    """One page, and what its person has chosen to see there; other pages choose for themselves.

    Args:
        client: the page.
        asked: the id of the agent that the page is about; empty if it is about none.
        address: under which the browser has the page; empty if nobody knows.
        is_dark: whether its person likes it dark.
    """

    def __init__(
        self, client: ClientHandle, asked: str = "", address: str = "", *, is_dark: bool = False
    ) -> None:
        self.client = client
        self.address = address
        self.is_dark = is_dark
        self.view = View(client)
        """Its camera."""
        self.agent = asked
        """The id of the agent that it looks at."""
        self._lit: dict[tuple[str, str], bool] = {}

    def settle(self, ids: Sequence[str]) -> None:
        """Looks at one of these agents: the one that it looks at, or else the first."""
        if self.agent not in ids:
            self.agent = ids[0]

    def lights(self, key: str, *, by_itself: bool) -> bool:
        """Whether a sensor of the agent is shown in the scene.

        Args:
            key: the sensor's perception key.
            by_itself: whether it is shown unless somebody has switched it off.
        """
        return self._lit.get((self.agent, key), by_itself)

    def light(self, key: str, on: bool) -> None:
        """Shows a sensor of the agent in the scene, or no longer."""
        self._lit[self.agent, key] = on


class ViewerClients(Mapping[int, ViewerClient]):
    """Everybody who looks at a page, by viser's number of it.

    Args:
        server: viser's.
        first: the id of the agent that a page shows which is about none in particular.
    """

    def __init__(self, server: LocalServer, first: str) -> None:
        self._server = server
        self._first = first
        self._ids: tuple[str, ...] = (first,)
        self._all: dict[int, ViewerClient] = {}

    def __getitem__(self, client_id: int) -> ViewerClient:
        return self._all[client_id]

    def __iter__(self) -> Iterator[int]:
        return iter(tuple(self._all))

    def __len__(self) -> int:
        return len(self._all)

    def build(self, static_scene: StaticScene) -> None:
        """Learns which agents there are."""
        ids = list(static_scene.agent_of.values())
        self._ids = tuple(sorted(ids, key=lambda each: each != self._first))
        for viewer_client in self._all.values():
            viewer_client.settle(self._ids)

    def draw(self, _snapshot: Snapshot) -> None:
        """Greets new pages: before other parts draw for them."""
        self.meet()

    def meet(self) -> None:
        """Greets pages that have come, and forgets those that have gone."""
        clients = self._server.get_clients()
        for gone in self._all.keys() - clients.keys():
            del self._all[gone]
        for new in sorted(clients.keys() - self._all.keys()):
            asked, address = unquote(self._told(new, AGENT_HEADER)), self._told(new, PAGE_HEADER)
            is_dark = bool(self._told(new, DARK_HEADER))
            viewer_client = ViewerClient(clients[new], asked, address, is_dark=is_dark)
            viewer_client.settle(self._ids)
            self._all[new] = viewer_client

    def _told(self, client_id: int, header: str) -> str:
        connection = self._server._websock_server._live_connections.get(client_id)
        request = getattr(connection, "request", None)
        return str(request.headers.get(header, "")) if request is not None else ""
