"""Limits for uploaded files: their size, one at a time, and a timeout.

viser assembles files of any size, and waits for missing parts as long as the page is connected.
Here a file that is too large is refused before its first part, and an unfinished one is dropped
after :data:`UPLOAD_IDLE_S`.
"""

import asyncio
from typing import Any

from viser import ClientHandle, GuiEvent, UploadedFile
from viser._gui_api import GuiApi
from viser._messages import FileTransferPart, FileTransferStartUpload
from viser.infra import ClientId

MAX_PARTS = 1000
"""Most parts of a file; the page sends parts of 512 KiB."""
UPLOAD_IDLE_S = 30.0
"""Time (s) without a new part after which a file is dropped."""


def limit_uploads(client: ClientHandle, largest: int) -> None:
    """Limit the size of files that a page uploads; of several calls, the largest limit holds.

    Args:
        client: the page.
        largest: largest size in bytes.
    """
    known = getattr(client.gui, "_ai4u_limit", None)
    if isinstance(known, _Limit):
        known.largest = max(known.largest, largest)
        return
    client.gui._ai4u_limit = _Limit(client, largest)  # type: ignore[attr-defined]


def take_file(event: GuiEvent[Any]) -> UploadedFile:
    """Return the uploaded file, and release the button's reference to it."""
    state = event.target._impl
    file: UploadedFile = state.value
    state.value = UploadedFile("", b"")
    return file


class _Limit:
    """Checks in front of viser's two upload handlers; viser's event loop calls it."""

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
        uploads = self._gui._current_file_upload_states
        if not 0 <= message.size_bytes <= self.largest:
            self._refuse(f"expected at most {self.largest // 2**20} MB")
        elif not 0 <= message.part_count <= MAX_PARTS:
            self._refuse(f"expected at most {MAX_PARTS} parts")
        elif not message.part_count and message.size_bytes:
            self._refuse("it is smaller than it said")
        elif uploads:
            uploads.clear()
            self._refuse("expected one file at a time")
        else:
            self._gui._handle_file_transfer_start(client_id, message)
        self._restart_timer()

    def _part(self, client_id: ClientId, message: FileTransferPart) -> None:
        uploads = self._gui._current_file_upload_states
        state = uploads.get(message.transfer_uuid)
        if state is None:
            return
        size, parts = state["transferred_bytes"] + len(message.content), state["parts"]
        is_last = message.part_index not in parts and len(parts) + 1 == state["part_count"]
        if size > state["total_bytes"] or (is_last and size < state["total_bytes"]):
            del uploads[message.transfer_uuid]
            more = size > state["total_bytes"]
            self._refuse(f"it is {'larger' if more else 'smaller'} than it said")
        else:
            self._gui._handle_file_transfer_part(client_id, message)
        self._restart_timer()

    def _restart_timer(self) -> None:
        """Restart the timeout for the next part, if one is missing."""
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
