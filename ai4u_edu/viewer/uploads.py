"""Files that a page sends: no larger than they may be, and no more than one at a time.

viser puts together whatever a page sends, however large. Here what is too large is refused before
its first byte is kept.
"""

from viser import ClientHandle
from viser._gui_api import GuiApi
from viser._messages import FileTransferPart, FileTransferStartUpload
from viser.infra import ClientId


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


class _Limit:
    """Stands before viser's two handlers."""

    def __init__(self, client: ClientHandle, largest: int) -> None:
        self.largest = largest
        self._client = client
        self._gui: GuiApi = client.gui
        socket = self._gui._websock_interface
        socket.unregister_handler(FileTransferStartUpload, self._gui._handle_file_transfer_start)
        socket.unregister_handler(FileTransferPart, self._gui._handle_file_transfer_part)
        socket.register_handler(FileTransferStartUpload, self._start)
        socket.register_handler(FileTransferPart, self._part)

    def _start(self, client_id: ClientId, message: FileTransferStartUpload) -> None:
        under_way = self._gui._current_file_upload_states
        if message.size_bytes > self.largest or message.part_count > self.largest:
            self._refuse(f"expected at most {self.largest // 2**20} MB")
        elif under_way:
            under_way.clear()
            self._refuse("expected one file at a time")
        else:
            self._gui._handle_file_transfer_start(client_id, message)

    def _part(self, client_id: ClientId, message: FileTransferPart) -> None:
        under_way = self._gui._current_file_upload_states
        state = under_way.get(message.transfer_uuid)
        if state is None:
            return
        if state["transferred_bytes"] + len(message.content) > state["total_bytes"]:
            del under_way[message.transfer_uuid]
            self._refuse("it is larger than it said")
            return
        self._gui._handle_file_transfer_part(client_id, message)

    def _refuse(self, why: str) -> None:
        self._client.add_notification("That file can't be taken", why, auto_close_seconds=8.0)
