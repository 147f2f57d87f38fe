"""A running world and its page: the one place that puts picture, panel and server together."""

import logging
import threading
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Protocol, Self

from starlette.applications import Starlette

from ai4u_edu.base.options import PAGE_OPTIONS, MissingOptionError, OptionTab, load_option
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel import PanelContext, PanelSockets
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.panel.parts.due import Parts
from ai4u_edu.page.panel.socket import PanelOption
from ai4u_edu.page.server import LOOPBACK, Rules, ServerThread, lock_viser_port, room_app
from ai4u_edu.page.server.class_feed import ClassFeed
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts
from ai4u_edu.page.server.scripts import ScriptLog
from ai4u_edu.page.server.start_page import MissionsView
from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.sense_overlay import PictureOption
from ai4u_edu.recording import Ghosts
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner

DEFAULT_TITLE = "AI4U Edu"
STOP_S = 2.0
"""Time that all threads of a page usually have to end."""
_logger = logging.getLogger(__name__)


class Option(PanelOption, PictureOption, Protocol):
    """An option of one world's page: it adds parts of picture and panel, commands and a tab."""

    @property
    def tab(self) -> OptionTab | None:
        """Its tab of the panel; None if it brings none."""

    def stop(self) -> None:
        """End its threads, without waiting for code of a student that may not return."""


def serve_world(
    runner: Runner,
    *,
    title: str = "",
    editor: SceneEditor | None = None,
    port: int | None = 0,
    rules: Rules | None = None,
    ghosts: Ghosts | None = None,
    allowed_hosts: Collection[str] = LOOPBACK,
    proxy_hosts: Collection[str] = (),
    viser_secret: str = PROXY_SECRET,
    missions: Callable[[], MissionsView] | None = None,
    class_feed: ClassFeed | None = None,
    script_report: ScriptLog | None = None,
    options: Sequence[str] = PAGE_OPTIONS,
    timeouts: Timeouts = DEFAULT_TIMEOUTS,
) -> "ServedWorld":
    """Serve the page and the API of a running world, for this machine, until it is stopped.

    The runner stays the caller's, who starts it before or after, or ticks it with
    :meth:`Runner.advance <ai4u_edu.runtime.runner.Runner.advance>`, and stops it in the end. Any
    kind of world will do: one of a scene, or one made in Python.

    To serve it for other machines, or below a path of another app, take no port, and give the
    :attr:`~ServedWorld.app` to :func:`ai4u_edu.page.server.serve` or to your own app.

    Args:
        runner: runs the world.
        title: the page's title; default: that of the editor's scene.
        editor: lets pages change the world; without it pages can watch and drive only.
        port: port on 127.0.0.1; 0 for a free one, None for no server.
        rules: for scripts that drive agents; page and API ask for their token, too.
        ghosts: recorded episodes to race against; by default pages choose some.
        allowed_hosts: host names of requests; see :mod:`ai4u_edu.page.server.host_origin`.
        proxy_hosts: host names of a reverse proxy in front; see there.
        viser_secret: secret of the world's viser; only a proxy may know it.
        missions: returns the missions on the start page, at which pages also open other scenes; it
            needs an editor. Default: no start page.
        class_feed: of the class that the world belongs to; pages show it.
        script_report: of what happens with scripts.
        options: modules that add to the page, each with a function ``page_option``, which takes the
            runner, the player and the editor and returns an :class:`Option`; those that can't be
            imported are left out.
        timeouts: time limits of connections and answers.

    Raises:
        PortTakenError: another program listens at the port.

    >>> import httpx
    >>> from ai4u_edu import Scene
    >>> from ai4u_edu.runtime.runner import Runner
    >>> runner = Runner(Scene.load("box_chase").build(), seed=1)
    >>> runner.start()
    >>> with serve_world(runner, title="My world") as world:
    ...     httpx.get(world.url + "healthz").json()["scene"]
    'My world'
    >>> runner.stop()
    """
    player, ghosts = ReplayPlayer(runner), ghosts or Ghosts()
    added = _load(options, runner, player, editor)
    title = title or (DEFAULT_TITLE if editor is None else editor.title)
    viewer = Viewer(runner, title=title, editor=editor, ghosts=ghosts, options=added)
    lock_viser_port(viewer.server, viser_secret)
    tabs = [option.tab for option in added if option.tab is not None]
    context = PanelContext(runner, viewer.viewer_clients, player, ghosts, editor, timeouts)
    app = room_app(
        runner,
        viser_port=viewer.port,
        viser_secret=viser_secret,
        title=title if editor is None else lambda: editor.title,
        allowed_hosts=allowed_hosts,
        proxy_hosts=proxy_hosts,
        rules=rules,
        panel=PanelSockets(context, [*added, _TabList(tabs)] if tabs else added),
        tab_scripts={tab.name: tab.script for tab in tabs},
        editor=None if missions is None else editor,
        missions=missions or MissionsView,
        class_feed=class_feed,
        script_report=script_report,
        timeouts=timeouts,
    )
    server = None
    try:
        if port is not None:
            server = ServerThread(app, port=port, timeouts=timeouts)
    except BaseException:
        viewer.stop()
        raise
    return ServedWorld(app, viewer, context, added, server)


class ServedWorld:
    """A world whose page is served; :func:`serve_world` makes it.

    Its own threads draw the world, play recorded episodes, explain actions and answer requests.
    None of them runs physics or blocks of the running world, nor changes it: they read the runner's
    latest snapshot, and submit commands to the runner. Any thread may call :meth:`stop`, once.

    Args:
        app: page and API.
        viewer: draws the world.
        context: the world and what belongs to it.
        options: what is added to the page.
        server: serves the app; None if the caller does.
    """

    def __init__(
        self,
        app: Starlette,
        viewer: Viewer,
        context: PanelContext,
        options: Sequence[Option],
        server: ServerThread | None,
    ) -> None:
        self.app = app
        """ASGI app of page and API; mount it under a path with
        :class:`~ai4u_edu.page.server.RoomMount`."""
        self.viewer = viewer
        """Draws the world with viser; knows the open pages."""
        self.context = context
        """The runner, the player of recorded episodes, the ghosts and the editor."""
        self.url = "" if server is None else server.url
        """The page's address, with a slash at the end; empty without a server."""
        self._options, self._server = options, server
        viewer.start()
        if server is not None:
            server.start()

    def stop(self, timeout: float = STOP_S) -> None:
        """Stop serving and drawing the world; the runner goes on.

        Blocks of a replayed episode may not return. Threads that do not end in time are left
        behind; they are daemons.

        Args:
            timeout: time (s) that the threads have to end.
        """
        if self._server is not None:
            self._server.stop()
        for option in self._options:
            option.stop()
        ending = threading.Thread(target=self._end, name="page end", daemon=True)
        ending.start()
        ending.join(timeout)

    def _end(self) -> None:
        self.viewer.stop()
        self.context.player.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()


class _TabList(PanelOption):
    """Part "tabs" of the panel: the tabs that options bring."""

    commands: Mapping[type[PageCommand], Handler] = {}
    agent_parts = ()

    def __init__(self, tabs: Sequence[OptionTab]) -> None:
        shown = [{"name": tab.name, "title": tab.title} for tab in tabs]
        self._part = {"type": "part", "name": "tabs", "tabs": shown}

    def panel_parts(self, context: PanelContext, view: PageView) -> Parts:  # noqa: ARG002
        """Yield the part, which is the same for all pages."""
        yield "tabs", context.cache.by_key("tabs", lambda: self._part)


def _load(
    modules: Sequence[str], runner: Runner, player: ReplayPlayer, editor: SceneEditor | None
) -> list[Option]:
    """Return the options of a world's page; one that can't be imported is left out."""
    options: list[Option] = []
    for name in modules:
        try:
            make: Callable[[Runner, ReplayPlayer, SceneEditor | None], Option]
            make = load_option(name, "the whole page").page_option
        except MissingOptionError as error:
            _logger.info("%s", error)
        else:
            options.append(make(runner, player, editor))
    return options
