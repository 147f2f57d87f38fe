"""Checks of pages' messages before viser and our callbacks get them.

viser sets any attribute of a widget that a page names, casts any value, and sends it to all other
pages. It runs callbacks in tasks whose exceptions nobody retrieves. So each message is checked
first: a page can only give a widget a value that this widget can have, and only submit a form that
exists. An error in a callback is shown to the page that caused it, and logged once.

The proxy checks the types of all other fields, see :mod:`ai4u_edu.server.page_messages`. See
``docs/adr/0002-check-what-pages-send-before-viser.md``.
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
from viser.infra import ClientId, Message, WebsockClientConnection, WebsockServer

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.viewer.backend.reporting import describe_error
from ai4u_edu.viewer.backend.widget_values import ValueRefusedError, checked_value

NOTIFICATION_PERIOD_S = 1.0
"""Shortest time between two error notifications to a page."""
MAX_PRESSES_PER_S = 30
"""Rate limit for pressing, choosing and submitting; nobody is that quick."""
MAX_PRESSES_AT_ONCE = 100
"""Burst that the rate limit allows: all that was done while a page had no connection."""

_logger = logging.getLogger(__name__)

Handler = Callable[[ClientId, Message], Awaitable[None]]


class IncomingMessages:
    """Checks the messages of all pages. Belongs to viser's event loop.

    It replaces the method with which viser dispatches a message, on the server's socket and on each
    page's: viser dispatches to both, and the one that has the widget handles it.

    Args:
        server: viser's.
    """

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._notified_at: dict[int, float] = {}
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
        self._notified_at.pop(connection.client_id, None)
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
                self._notify(client_id, describe_error(error))

        socket._handle_incoming_message = handle_checked  # type: ignore[method-assign]

    def _is_allowed(self, client_id: ClientId, message: Message, gui: GuiApi | None) -> bool:
        """Return True if viser may dispatch a message; convert a value to its widget's type."""
        match message:
            case GuiUpdateMessage():
                widget = gui and gui._gui_input_handle_from_uuid.get(message.uuid)
                return bool(widget) and self._is_value(client_id, message, widget)
            case GuiFormSubmitMessage() | GuiFormDirtyMessage():
                # viser would keep state for each form that a page makes up
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
            self._resend_value(client_id, widget)
            if error.is_typed:
                self._notify(client_id, str(error))
            return False
        # typing and dragging send many, and start nothing
        is_filled_in = isinstance(widget, GuiTextHandle | GuiNumberHandle | GuiSliderHandle)
        return is_filled_in or self._may_press(client_id)

    def _may_press(self, client_id: ClientId) -> bool:
        """Return False if a page exceeds the rate limit: its presses would queue up."""
        now = time.monotonic()
        left, since = self._presses.get(client_id, (MAX_PRESSES_AT_ONCE, now))
        left = min(MAX_PRESSES_AT_ONCE, left + (now - since) * MAX_PRESSES_PER_S)
        may = left >= 1
        self._presses[client_id] = (left - may, now)
        if not may:
            self._log(logging.WARNING, "presses", f"expected at most {MAX_PRESSES_PER_S} a second")
        return may

    def _resend_value(self, client_id: ClientId, widget: Any) -> None:
        """Send a page the value that a widget has."""
        client, value = self._client(client_id), widget.value
        if client is not None and isinstance(value, bool | int | float | str):
            update = GuiUpdateMessage(widget._impl.uuid, {"value": value})
            client._websock_connection.queue_message(update)

    def _notify(self, client_id: ClientId, text: str) -> None:
        client, now = self._client(client_id), time.monotonic()
        if (
            client is None
            or now - self._notified_at.get(client_id, -NOTIFICATION_PERIOD_S)
            < NOTIFICATION_PERIOD_S
        ):
            return
        self._notified_at[client_id] = now
        client.add_notification("That didn't work", f"{text:.500}", auto_close_seconds=8.0)

    def _log(self, level: int, key: str, text: str) -> None:
        log_limited(_logger, level, key, "a page's message was left out: %a", text)
