"""The tabs of each page's panel."""

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from viser import PanelHandle

from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.runtime.frame_budget import TEXTS_PER_S, PageTurns
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.viewer_client import ViewerClient, ViewerClients


class Tab(Protocol):
    """The content of one tab on one page.

    viser does not report which tab is open, so all tabs are drawn. It sends only changed values, so
    an unchanged tab costs no messages.
    """

    def draw(self, snapshot: Snapshot) -> None:
        """Show a snapshot; called several times a second, and at once for a new static scene."""


class TabKind(NamedTuple):
    """A tab that every page has."""

    title: str
    """The tab's label, one short word."""
    open: Callable[[ViewerClient], Tab]
    """Fill the tab of one page. Called inside the tab's GUI container, so whatever is added to
    ``viewer_client.client.gui`` lands in the tab."""


class Tabs:
    """A panel below the main one, with a tab of each kind, on each page.

    Args:
        viewer_clients: the pages.
        kinds: the tabs, from left to right.
        error_log: logs errors of a tab; the other tabs are drawn nevertheless.
    """

    def __init__(
        self,
        viewer_clients: ViewerClients,
        kinds: Sequence[TabKind],
        error_log: ErrorLog,
    ) -> None:
        self._viewer_clients = viewer_clients
        self.kinds = tuple(kinds)
        self._error_log = error_log
        self.pages: dict[int, _Page] = {}

    def build(self, static_scene: StaticScene) -> None:  # noqa: ARG002 - tabs find it in snapshots
        """Draw all pages anew, at once."""
        self._turns = PageTurns(TEXTS_PER_S)

    def draw(self, snapshot: Snapshot) -> None:
        """Show a snapshot in all tabs of the pages whose turn it is; add tabs to new pages."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for new in self._viewer_clients.keys() - self.pages.keys():
            if self._viewer_clients[new].page_id:
                continue  # it has our panel
            self.pages[new] = _Page(self._viewer_clients[new], self.kinds, self._error_log)
        for number in self._turns.due(self.pages.keys()):
            for tab in self.pages[number].tabs:
                with self._error_log.caught():
                    tab.draw(snapshot)


class _Page:
    """The panel of one page."""

    def __init__(
        self, viewer_client: ViewerClient, kinds: Sequence[TabKind], error_log: ErrorLog
    ) -> None:
        gui = viewer_client.client.gui
        self.tabs: list[Tab] = []
        self.panel: PanelHandle = gui.add_panel()
        for kind in kinds:
            with error_log.caught(), self.panel.add_tab(kind.title):
                self.tabs.append(kind.open(viewer_client))
        self.panel.dock_below(gui.main_panel)
