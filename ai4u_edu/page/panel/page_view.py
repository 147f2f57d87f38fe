"""The things that one page looks at, and the link to the page's picture in viser."""

from collections.abc import Callable

from ai4u_edu.explain.elsewhere import Elsewhere
from ai4u_edu.explain.live_maps import MapChoice
from ai4u_edu.page.panel.messages.base import Show
from ai4u_edu.page.viewer.scene.view import Mode
from ai4u_edu.page.viewer.viewer_client import PagePanel, ViewerClient, ViewerClients

TEXTS_PER_CURVE = 4
"""Times that the other texts are sent for each curve of rewards, which is longer than all else."""
EXPLANATIONS = {"why", "maps"}
"""Names of the parts that a page clears when it shows another agent."""
MAX_SENSOR_CHOICES = 200
"""Most sensors that a page has switched on or off and that are remembered."""


class PageView:
    """The things that one page looks at, and its choices.

    viser's connection of the page may come later than the panel's, and may come again: choices are
    kept here and applied whenever there is another client. A panel that connects again takes over
    what its picture shows. Belongs to the server's event loop.

    Args:
        viewer_clients: viser's clients.
        page_id: the page's random id; empty if it has no picture.
        agent: id of the agent that is shown first.
        panel: told what the user does in the picture.
    """

    def __init__(
        self, viewer_clients: ViewerClients, page_id: str, agent: str, panel: PagePanel
    ) -> None:
        self._viewer_clients, self._page_id, self._panel = viewer_clients, page_id, panel
        self._client: ViewerClient | None = None
        self.show = Show(type="show", agent=agent)
        self._camera: Mode | None = None
        self.is_move_mode = False
        self.is_why_shown = False
        """True if the page shows why the agent acts as it does."""
        self.maps = MapChoice()
        """The maps over the floor that the page shows."""
        self.elsewhere: Elsewhere | None = None
        """The place at which the page tries the agent; None if it does not."""
        self.snap_m = 0.0
        self.trails: dict[str, bool] = {}
        """Trails that were switched on or off, by agent."""
        self._is_dark: bool | None = None
        self._is_motion_reduced = False
        self._curve: tuple[str, int] = ("", 0)
        self.sensors: dict[tuple[str, str], bool] = {}
        """Sensors that were switched on or off, by agent and key."""
        self._asked_again: set[str] = set()

    @property
    def agent(self) -> str:
        """Id of the agent that the page shows."""
        return self.show.agent

    @property
    def camera(self) -> Mode:
        """Position of the page's camera."""
        return self._camera or Mode.ARENA

    @property
    def address(self) -> str:
        """The page's address in the browser; empty if it is not known."""
        return "" if self._client is None else self._client.address

    @property
    def client(self) -> ViewerClient | None:
        """Viser's client of this page; None while there is none."""
        return self._client

    def ask_again(self, *names: str) -> None:
        """Note that the page waits for parts, also if they are as before."""
        self._asked_again.update(names)

    def take_asked_again(self) -> set[str]:
        """Return the names of the parts that the page waits for again, since the last call.

        It shows nothing of them until they come, so they are sent even if they are as before.
        """
        names, self._asked_again = self._asked_again, set()
        return names

    def refresh(self) -> None:
        """Find viser's client of this page, and give a new one all that was chosen."""
        client = self._viewer_clients.find(self._page_id)
        if client is not self._client:
            self._client = client
            if client is not None:
                self._take_over(client)
                self._choose_all(client)

    def look_at(self, show: Show) -> None:
        """Look at something else."""
        if show.agent != self.agent:
            self.ask_again(*EXPLANATIONS)
        self.show = show
        self._apply(self._choose_shown)

    def choose_agent(self, agent: str) -> None:
        """Look at another agent."""
        self.ask_again(*EXPLANATIONS)
        self.show = Show(
            type="show",
            agent=agent,
            tabs=self.show.tabs,
            body=self.show.body,
            episode=self.show.episode,
        )
        self._apply(self._choose_shown)

    def is_curve_due(self) -> bool:
        """Return True if the agent's curve of rewards is to be sent with the other texts now."""
        agent, left = self._curve
        is_due = agent != self.agent or left <= 0
        self._curve = self.agent, TEXTS_PER_CURVE - 1 if is_due else left - 1
        return is_due

    def choose_camera(self, mode: Mode) -> None:
        """Put the camera somewhere."""
        self._camera = mode
        self._apply(lambda client: client.view.choose(mode))

    def choose_dark(self, is_dark: bool) -> None:
        """Draw the picture in dark or light colours."""
        self._is_dark = is_dark
        self._apply(lambda client: client.set_dark(is_dark))

    def reduce_motion(self, on: bool) -> None:
        """Leave out motion that nothing in the world makes, or not."""
        self._is_motion_reduced = on
        self._apply(self._choose_shown)

    def show_sensor(self, key: str, on: bool) -> None:
        """Draw a sensor of the agent in the picture, or hide it."""
        if len(self.sensors) >= MAX_SENSOR_CHOICES:
            self.sensors.clear()
        self.sensors[self.agent, key] = on
        self._apply(lambda client: client.show_sensor(key, on))

    def show_why(self, on: bool) -> None:
        """Show why the agent acts as it does, or no longer."""
        self.is_why_shown = on
        self.ask_again("why")
        self._apply(self._choose_shown)

    def show_maps(self, maps: MapChoice) -> None:
        """Show these maps over the floor."""
        self.maps = maps
        self.ask_again("maps")
        self._apply(self._choose_shown)

    def show_elsewhere(self, elsewhere: Elsewhere | None) -> None:
        """Show what the agent would do at another place, or no longer."""
        self.elsewhere = elsewhere
        self._apply(self._choose_shown)

    def show_trail(self, on: bool) -> None:
        """Draw the agent's trail, or hide it."""
        self.trails[self.show.agent] = on
        self._apply(self._choose_shown)

    def set_move_mode(self, on: bool) -> None:
        """Let the user drag bodies, or not."""
        self.is_move_mode = on
        self._apply(self._choose_shown)

    def set_snap(self, distance_m: float) -> None:
        """Let moved things snap to a grid; 0 for none."""
        self.snap_m = distance_m
        self._apply(self._choose_shown)

    def select(self, body: str | None) -> None:
        """Select a thing."""
        self.show.body = body
        self._apply(self._choose_shown)

    def close(self) -> None:
        """Forget the client; its picture stays as it is."""
        if self._client is not None and self._client.panel is self._panel:
            self._client.panel = None

    def _apply(self, choose: Callable[[ViewerClient], None]) -> None:
        if self._client is not None:
            choose(self._client)

    def _take_over(self, client: ViewerClient) -> None:
        """Take over what the picture shows, except for what was chosen since."""
        self._camera = self._camera or client.view.mode
        self.trails = client.trail_choices | self.trails
        self.sensors = client.sensor_choices | self.sensors

    def _choose_shown(self, client: ViewerClient) -> None:
        client.agent = self.show.agent
        client.selected = self.show.body or ""
        client.is_why_shown = self.is_why_shown
        client.maps, client.elsewhere = self.maps, self.elsewhere
        client.is_motion_reduced = self._is_motion_reduced
        client.is_move_mode, client.snap_m = self.is_move_mode, self.snap_m
        for agent, on in self.trails.items():
            client.show_trail(agent, on)

    def _choose_all(self, client: ViewerClient) -> None:
        client.panel = self._panel
        self._choose_shown(client)
        if self.camera is not client.view.mode:
            client.view.choose(self.camera)
        if self._is_dark is not None and self._is_dark != client.is_dark:
            client.set_dark(self._is_dark)
        for (agent, key), on in self.sensors.items():
            client.show_sensor(key, on, agent)
