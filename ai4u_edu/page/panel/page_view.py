"""The things that one page looks at, and the link to the page's picture."""

from collections.abc import Callable, Collection, Mapping
from concurrent.futures import Future
from typing import Annotated, Literal, Protocol

from msgspec import Meta

from ai4u_edu.page.editing import ChangeResult
from ai4u_edu.page.messages import Message, Name, Number, Others, Path

TEXTS_PER_CURVE = 4
"""Times that the other texts are sent for each curve of rewards, which is longer than all else."""
MAX_SENSOR_CHOICES = 200
"""Most sensors that a page has switched on or off and that are remembered."""


CameraMode = Literal["arena", "tilted", "follow", "turn", "eyes"]
"""Position of a page's camera: over the arena, tilted before it, over the agent, turning with it,
in its eye."""
Opening = Literal["none", "running", "ending", "over"]
"""State of the short tilt of the camera with which a page opens."""
Tab = Literal["agent", "blocks", "world", "past"]


class Show(Message, tag="show"):
    """The whole of what a page looks at; only the parts of open tabs are sent."""

    agent: Name
    """Id of the agent."""
    tabs: Annotated[tuple[Tab, ...], Meta(max_length=4)] = ()
    """Names of the parts of the open tabs."""
    block: Path | None = None
    """Path of the block whose form is shown; null for none."""
    body: Name | None = None
    """Name of the selected thing; null for none."""
    others: Others = ()
    """Names of the things that are selected with it."""
    episode: Number | None = None
    """Number of the chosen episode; null for none."""


class PictureListener(Protocol):
    """Gets what a user does in a page's picture; in the picture's thread."""

    def on_selected(self, body: str) -> None:
        """Note that somebody clicked on a body."""

    def on_dropped(self, change: "Future[ChangeResult]") -> None:
        """Report the result of a move with the mouse."""

    def send(self, message: Mapping[str, object]) -> None:
        """Send the page a message."""


class Picture(Protocol):
    """The picture of one page, as its panel needs it; whoever draws it reads these choices."""

    panel: PictureListener | None
    agent: str
    """Id of the agent that is shown."""
    selected: str
    """Name of the selected thing; empty if there is none."""
    others: tuple[str, ...]
    """Names of the things that are selected with it."""
    choices: dict[str, object]
    """Choices about options, by option."""
    is_motion_reduced: bool
    is_move_mode: bool
    knob_share: float
    """Radius of the handles' knobs, as a share of the picture's height."""
    snap_m: float

    @property
    def address(self) -> str:
        """The page's address in the browser; empty if it is not known."""

    @property
    def camera(self) -> CameraMode:
        """Position of the camera."""

    @property
    def opening(self) -> Opening:
        """State of the short tilt of the camera with which the page opens."""

    def open(self) -> None:
        """Open with a short tilt of the camera, unless it has done so or its pictures are few."""

    def end_opening(self) -> None:
        """End the tilt."""

    @property
    def ground_center(self) -> tuple[float, float]:
        """Point (x, y) of the ground in the middle of the picture (m)."""

    def ground_matrix(self, z: float) -> tuple[float, ...]:
        """Return the map from the picture to the ground at a height (m), 3 x 3, row by row.

        It takes (across, down, 1), shares of the picture's width and height, to (w x, w y, w).
        """

    @property
    def is_dark(self) -> bool:
        """True for dark colours."""

    @property
    def sensor_choices(self) -> dict[tuple[str, str], bool]:
        """Sensors that were switched on or off, by agent and key."""

    @property
    def trail_choices(self) -> dict[str, bool]:
        """Trails that were switched on or off, by agent."""

    def choose_camera(self, mode: CameraMode) -> None:
        """Put the camera somewhere, also if it was there before and was moved since."""

    def set_dark(self, is_dark: bool) -> None:
        """Draw in dark or light colours."""

    def show_sensor(self, key: str, on: bool, agent: str = "") -> None:
        """Draw a sensor, or hide it; by default one of the agent that is shown."""

    def show_trail(self, agent_id: str, on: bool) -> None:
        """Draw the trail behind an agent, or hide it."""


class Pictures(Protocol):
    """The pictures of all open pages."""

    def find(self, page_id: str) -> Picture | None:
        """Return the latest picture of a page; None if there is none."""


class PageView:
    """The things that one page looks at, and its choices.

    The connection of the page's picture may come later than the panel's, and may come again:
    choices are kept here and applied whenever there is another picture. A panel that connects again
    takes over what its picture shows. Belongs to the server's event loop.

    Args:
        pictures: those of all pages.
        page_id: the page's random id; empty if it has no picture.
        agent: id of the agent that is shown first.
        panel: notified of what the user does in the picture.
        agent_parts: names of the parts that the page clears when it shows another agent.
    """

    def __init__(
        self,
        pictures: Pictures,
        page_id: str,
        agent: str,
        panel: PictureListener,
        agent_parts: Collection[str] = (),
    ) -> None:
        self._pictures, self._page_id, self._panel = pictures, page_id, panel
        self._agent_parts = agent_parts
        self._picture: Picture | None = None
        self.show = Show(agent=agent)
        self._camera: CameraMode | None = None
        self.is_move_mode = False
        self._knob_share = 0.025
        self.choices: dict[str, object] = {}
        """Choices about options, by option; the page's picture gets the same."""
        self.snap_m = 0.0
        self.trails: dict[str, bool] = {}
        """Trails that were switched on or off, by agent."""
        self._is_dark: bool | None = None
        self._is_motion_reduced = False
        self._opens = False
        """True if the next picture opens with a tilt."""
        self._curve: tuple[str, int] = ("", 0)
        self.sensors: dict[tuple[str, str], bool] = {}
        """Sensors that were switched on or off, by agent and key."""
        self._asked_again: set[str] = set()

    @property
    def agent(self) -> str:
        """Id of the agent that the page shows."""
        return self.show.agent

    @property
    def camera(self) -> CameraMode:
        """Position of the page's camera."""
        return self._camera or "arena"

    @property
    def address(self) -> str:
        """The page's address in the browser; empty if it is not known."""
        return "" if self._picture is None else self._picture.address

    @property
    def ground_center(self) -> tuple[float, float] | None:
        """Point (x, y) of the ground in the middle of the picture (m); None without a picture."""
        return None if self._picture is None else self._picture.ground_center

    def ground_matrix(self, z: float) -> tuple[float, ...] | None:
        """Return the map from the picture to the ground at a height; None without a picture."""
        return None if self._picture is None else self._picture.ground_matrix(z)

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
        """Find the picture of this page, and give a new one all that was chosen."""
        picture = self._pictures.find(self._page_id)
        if picture is not self._picture:
            self._picture = picture
            if picture is not None:
                self._take_over(picture)
                self._choose_all(picture)

    def look_at(self, show: Show) -> None:
        """Look at something else."""
        if show.agent != self.agent:
            self.ask_again(*self._agent_parts)
        self.show = show
        self._apply(self._choose_shown)

    def choose_agent(self, agent: str) -> None:
        """Look at another agent."""
        self.ask_again(*self._agent_parts)
        self.show = Show(
            agent=agent,
            tabs=self.show.tabs,
            body=self.show.body,
            others=self.show.others,
            episode=self.show.episode,
        )
        self._apply(self._choose_shown)

    def is_curve_due(self) -> bool:
        """Return True if the agent's curve of rewards is due with the other texts."""
        agent, left = self._curve
        is_due = agent != self.agent or left <= 0
        self._curve = self.agent, TEXTS_PER_CURVE - 1 if is_due else left - 1
        return is_due

    def choose_camera(self, mode: CameraMode) -> None:
        """Put the camera somewhere."""
        self._camera = mode
        self._apply(lambda picture: picture.choose_camera(mode))

    def choose_dark(self, is_dark: bool) -> None:
        """Draw the picture in dark or light colours."""
        self._is_dark = is_dark
        self._apply(lambda picture: picture.set_dark(is_dark))

    def reduce_motion(self, on: bool) -> None:
        """Leave out motion that nothing in the world makes, or not."""
        self._is_motion_reduced = on
        self._apply(self._choose_shown)

    @property
    def opening(self) -> Opening:
        """State of the short tilt of the camera with which the page opens."""
        return "none" if self._picture is None else self._picture.opening

    def open(self) -> None:
        """Open with a short tilt of the camera, as soon as there is a picture."""
        self._opens = self._picture is None
        self._apply(lambda picture: picture.open())

    def end_opening(self) -> None:
        """End the tilt."""
        self._opens = False
        self._apply(lambda picture: picture.end_opening())

    def show_sensor(self, key: str, on: bool) -> None:
        """Draw a sensor of the agent in the picture, or hide it."""
        if len(self.sensors) >= MAX_SENSOR_CHOICES:
            self.sensors.clear()
        self.sensors[self.agent, key] = on
        self._apply(lambda picture: picture.show_sensor(key, on))

    def choose(self, option: str, choice: object, *parts: str) -> None:
        """Keep the page's choice about an option.

        Args:
            option: its key.
            choice: what was chosen.
            parts: names of the parts that the page waits for.
        """
        self.choices[option] = choice
        self.ask_again(*parts)
        self._apply(self._choose_shown)

    def show_trail(self, on: bool) -> None:
        """Draw the agent's trail, or hide it."""
        self.trails[self.show.agent] = on
        self._apply(self._choose_shown)

    def set_move_mode(self, on: bool, knob_share: float) -> None:
        """Let the user drag bodies, or not; with knobs of a radius as a share of the height."""
        self.is_move_mode, self._knob_share = on, knob_share
        self._apply(self._choose_shown)

    def set_snap(self, distance_m: float) -> None:
        """Let moved things snap to a grid; 0 for none."""
        self.snap_m = distance_m
        self._apply(self._choose_shown)

    def select(self, body: str | None, others: tuple[str, ...] = ()) -> None:
        """Select a thing, and others with it."""
        self.show.body, self.show.others = body, others
        self._apply(self._choose_shown)

    def close(self) -> None:
        """Forget the picture, which stays as it is."""
        if self._picture is not None and self._picture.panel is self._panel:
            self._picture.panel = None

    def _apply(self, choose: Callable[[Picture], None]) -> None:
        if self._picture is not None:
            choose(self._picture)

    def _take_over(self, picture: Picture) -> None:
        """Take over what the picture shows, except for what was chosen since."""
        self._camera = self._camera or picture.camera
        self.trails = picture.trail_choices | self.trails
        self.sensors = picture.sensor_choices | self.sensors

    def _choose_shown(self, picture: Picture) -> None:
        picture.agent = self.show.agent
        picture.selected, picture.others = self.show.body or "", self.show.others
        picture.choices = self.choices
        picture.is_motion_reduced = self._is_motion_reduced
        picture.is_move_mode, picture.snap_m = self.is_move_mode, self.snap_m
        picture.knob_share = self._knob_share
        for agent, on in self.trails.items():
            picture.show_trail(agent, on)

    def _choose_all(self, picture: Picture) -> None:
        picture.panel = self._panel
        self._choose_shown(picture)
        if self.camera != picture.camera:
            picture.choose_camera(self.camera)
        if self._opens:
            self._opens = False
            picture.open()
        if self._is_dark is not None and self._is_dark != picture.is_dark:
            picture.set_dark(self._is_dark)
        for (agent, key), on in self.sensors.items():
            picture.show_sensor(key, on, agent)
