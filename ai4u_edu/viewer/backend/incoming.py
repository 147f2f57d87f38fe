"""Checks of what pages send, before viser and our callbacks get it.

viser sets any attribute of a widget that a page names, casts any value, and tells all other pages.
It runs callbacks in tasks that nobody waits for. So each message passes through here first: a page
can only give a widget a value that this widget can have, and only what is there can be submitted.
What goes wrong in a callback is written once, and told to the page that caused it.

The types of all other fields are checked by the proxy, :mod:`ai4u_edu.server.page_messages`: behind
it no other message arrives.
"""

import logging
import time
from collections.abc import Awaitable, Callable
from typing import Any

from viser import (
    ClientHandle,
    GuiFormHandle,
    GuiNumberHandle,
    GuiSliderHandle,
    GuiTextHandle,
    GuiUploadButtonHandle,
    ViserServer,
)
from viser._gui_api import GuiApi
from viser._messages import (
    FileTransferStartUpload,
    GuiFormDirtyMessage,
    GuiFormSubmitMessage,
    GuiUpdateMessage,
)
from viser.infra import ClientId, WebsockClientConnection, WebsockServer
from viser.infra._messages import Message

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.viewer.backend.reporting import reported
from ai4u_edu.viewer.backend.widget_values import ValueRefusedError, checked_value

TELL_PERIOD_S = 1.0
"""A page is told at most once within this time that something didn't work."""
MAX_PRESSES_PER_S = 30
"""Rate at which a page may press, choose and submit in the long run; nobody is that quick."""
MAX_PRESSES_AT_ONCE = 100
"""Burst that is heard without a break: all that was done while a page had no connection."""

_logger = logging.getLogger(__name__)

Handler = Callable[[ClientId, Message], Awaitable[None]]


class IncomingMessages:
    """Checks the messages of all pages; belongs to viser's loop.

    Replaces the method by which viser dispatches a message, on the server's socket, and on each
    page's: a message goes to both, and concerns the one that has its widget.

    Args:
        server: viser's.
    """

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._told_at: dict[int, float] = {}
        self._presses: dict[int, tuple[float, float]] = {}
        web = server._websock_server
        self._check(web, lambda _: server.gui)
        web.on_client_connect(self._on_connect)
        web.on_client_disconnect(self._on_disconnect)

    async def _on_connect(self, connection: WebsockClientConnection) -> None:
        def gui_of(client_id: int) -> GuiApi | None:
            client = self._client(client_id)
            return None if client is None else client.gui

        self._check(connection, gui_of)

    async def _on_disconnect(self, connection: WebsockClientConnection) -> None:
        self._told_at.pop(connection.client_id, None)
        self._presses.pop(connection.client_id, None)

    def _client(self, client_id: int) -> ClientHandle | None:
        return self._server.get_clients().get(client_id)

    def _check(
        self,
        socket: WebsockServer | WebsockClientConnection,
        gui_of: Callable[[int], GuiApi | None],
    ) -> None:
        handle: Handler = socket._handle_incoming_message

        async def handle_checked(client_id: ClientId, message: Message) -> None:
            try:
                if self._is_allowed(client_id, message, gui_of(client_id)):
                    await handle(client_id, message)
            except Exception as error:
                self._tell(client_id, reported(error))

        socket._handle_incoming_message = handle_checked  # type: ignore[method-assign]

    def _is_allowed(self, client_id: ClientId, message: Message, gui: GuiApi | None) -> bool:
        """Return True if viser may have a message; a widget's value is made one of its kind."""
        match message:
            case GuiUpdateMessage():
                widget = gui and gui._gui_input_handle_from_uuid.get(message.uuid)
                return bool(widget) and self._is_value(client_id, message, widget)
            case GuiFormSubmitMessage() | GuiFormDirtyMessage():
                # viser would keep a word about each form that a page makes up
                form = gui and gui._container_handle_from_uuid.get(message.uuid)
                is_form = isinstance(form, GuiFormHandle)
                return is_form and self._may_press(client_id)
            case FileTransferStartUpload():
                where = message.source_component_uuid
                widget = gui and gui._gui_input_handle_from_uuid.get(where)
                return isinstance(widget, GuiUploadButtonHandle)
        return True

    def _is_value(self, client_id: ClientId, message: GuiUpdateMessage, widget: Any) -> bool:
        if message.updates.keys() != {"value"}:
            names = sorted(map(str, message.updates))
            self._log(logging.WARNING, "attribute", f"expected 'value' only, got {names!r:.200}")
            return False
        try:
            message.updates["value"] = checked_value(widget, message.updates["value"])
        except ValueRefusedError as error:
            self._log(logging.INFO, "value", str(error))
            self._show_again(client_id, widget)
            if error.is_typed:
                self._tell(client_id, str(error))
            return False
        # while somebody types or drags there are many, and nothing is asked for
        is_filled_in = isinstance(widget, GuiTextHandle | GuiNumberHandle | GuiSliderHandle)
        return is_filled_in or self._may_press(client_id)

    def _may_press(self, client_id: ClientId) -> bool:
        """Return False if a page asks for more than can be done: it would be done long after."""
        now = time.monotonic()
        left, since = self._presses.get(client_id, (MAX_PRESSES_AT_ONCE, now))
        left = min(MAX_PRESSES_AT_ONCE, left + (now - since) * MAX_PRESSES_PER_S)
        may = left >= 1
        self._presses[client_id] = (left - may, now)
        if not may:
            self._log(logging.WARNING, "presses", f"expected at most {MAX_PRESSES_PER_S} a second")
        return may

    def _show_again(self, client_id: ClientId, widget: Any) -> None:
        """Have a page show the value that a widget has."""
        client, value = self._client(client_id), widget.value
        if client is not None and isinstance(value, bool | int | float | str):
            update = GuiUpdateMessage(widget._impl.uuid, {"value": value})
            client._websock_connection.queue_message(update)

    def _tell(self, client_id: ClientId, text: str) -> None:
        client, now = self._client(client_id), time.monotonic()
        if client is None or now - self._told_at.get(client_id, -TELL_PERIOD_S) < TELL_PERIOD_S:
            return
        self._told_at[client_id] = now
        client.add_notification("That didn't work", f"{text:.500}", auto_close_seconds=8.0)

    def _log(self, level: int, key: str, text: str) -> None:
        log_limited(_logger, level, key, "a page's message was left out: %a", text)
