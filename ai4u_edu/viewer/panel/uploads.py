"""Files that a page sends: no larger than they may be, and no more than one at a time.

viser puts together whatever a page sends, however large, and waits for the rest as long as the page
is there. Here what is too large is refused before its first byte is kept, and what is not finished
is dropped after a while.
"""

import asyncio
from typing import Any

from viser import ClientHandle, GuiEvent, UploadedFile
from viser._gui_api import GuiApi
from viser._messages import FileTransferPart, FileTransferStartUpload
from viser.infra import ClientId

MAX_PARTS = 1000
"""Parts of a file; the page makes them of 512 KiB."""
UPLOAD_IDLE_S = 30.0
"""A file whose next part does not come within this time is dropped."""


def limit_uploads(client: ClientHandle, largest: int) -> None:
    """Has a page send no file that is larger than so many bytes; called again, the largest counts.

    Args:
        client: the page.
        largest: bytes.
    """
    known = getattr(client.gui, "_ai4u_limit", None)
    if isinstance(known, _Limit):
        known.largest = max(known.largest, largest)
        return
    client.gui._ai4u_limit = _Limit(client, largest)  # type: ignore[attr-defined]


def take_file(event: GuiEvent[Any]) -> UploadedFile:
    """Return the file that was sent; its button keeps it no longer."""
    state = event.target._impl
    file: UploadedFile = state.value
    state.value = UploadedFile("", b"")
    return file


class _Limit:
    """Stands before viser's two handlers."""

    def __init__(self, client: ClientHandle, largest: int) -> None:
        self.largest = largest
        self._client = client
        self._gui: GuiApi = client.gui
        self._timer: asyncio.TimerHandle | None = None
        socket = self._gui._websock_interface
        socket.unregister_handler(FileTransferStartUpload, self._gui._handle_file_transfer_start)
        socket.unregister_handler(FileTransferPart, self._gui._handle_file_transfer_part)
        socket.register_handler(FileTransferStartUpload, self._start)
        socket.register_handler(FileTransferPart, self._part)

    def _start(self, client_id: ClientId, message: FileTransferStartUpload) -> None:
        under_way = self._gui._current_file_upload_states
        if not 0 <= message.size_bytes <= self.largest:
            self._refuse(f"expected at most {self.largest // 2**20} MB")
        elif not 0 <= message.part_count <= MAX_PARTS:
            self._refuse(f"expected at most {MAX_PARTS} parts")
        elif not message.part_count and message.size_bytes:
            self._refuse("it is smaller than it said")
        elif under_way:
            under_way.clear()
            self._refuse("expected one file at a time")
        else:
            self._gui._handle_file_transfer_start(client_id, message)
        self._watch()

    def _part(self, client_id: ClientId, message: FileTransferPart) -> None:
        under_way = self._gui._current_file_upload_states
        state = under_way.get(message.transfer_uuid)
        if state is None:
            return
        size, parts = state["transferred_bytes"] + len(message.content), state["parts"]
        is_last = message.part_index not in parts and len(parts) + 1 == state["part_count"]
        if size > state["total_bytes"] or (is_last and size < state["total_bytes"]):
            del under_way[message.transfer_uuid]
            more = size > state["total_bytes"]
            self._refuse(f"it is {'larger' if more else 'smaller'} than it said")
        else:
            self._gui._handle_file_transfer_part(client_id, message)
        self._watch()

    def _watch(self) -> None:
        """Wait for the next part, if one has to come, for a while only."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if self._gui._current_file_upload_states:
            loop = asyncio.get_running_loop()
            self._timer = loop.call_later(UPLOAD_IDLE_S, self._drop)

    def _drop(self) -> None:
        self._timer = None
        self._gui._current_file_upload_states.clear()
        self._refuse("the rest of it did not come")

    def _refuse(self, why: str) -> None:
        self._client.add_notification("That file can't be taken", why, auto_close_seconds=8.0)
