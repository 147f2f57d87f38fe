"""Handles to move things with the mouse, on the pages whose panel is ours."""

from concurrent.futures import Future
from functools import partial

from ai4u_edu.page.editing import ChangeResult, SceneEditor
from ai4u_edu.page.viewer.scene.handles import Handles
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import Snapshot, StaticScene


class PageHandles:
    """The handles of each page in move mode.

    Args:
        viewer_clients: the pages.
        editor: changes the things.
    """

    def __init__(self, viewer_clients: ViewerClients, editor: SceneEditor) -> None:
        self._viewer_clients, self._editor = viewer_clients, editor
        self.pages: dict[int, Handles] = {}

    def build(self, static_scene: StaticScene) -> None:  # noqa: ARG002 - handles find it in snapshots
        """Draw all pages' handles anew, at once."""
        self._turns = PageTurns(SENSES_PER_S)

    def draw(self, snapshot: Snapshot) -> None:
        """Move the handles to the things, and remove those of pages that left the move mode."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for number in self._turns.due(self._viewer_clients.keys()):
            client = self._viewer_clients[number]
            if number not in self.pages and not (client.page_id and client.is_move_mode):
                continue
            if number not in self.pages:
                self.pages[number] = Handles(
                    client, self._editor, partial(_choose, client), partial(_report, client)
                )
            handles = self.pages[number]
            handles.snap_m = client.snap_m
            handles.draw(snapshot, client.selected, on=client.is_move_mode)


def _choose(client: ViewerClient, name: str) -> None:
    client.selected = name
    if client.panel is not None:
        client.panel.on_selected(name)


def _report(client: ViewerClient, change: "Future[ChangeResult]") -> None:
    if client.panel is not None:
        client.panel.on_dropped(change)
