"""The connection of a bridge to an AI4U script on this machine, over UDP."""

import contextlib
import socket
import sys
import threading
import time

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, AI4UReply, SentState, SessionPhase
from ai4u_edu.wire.validation import WireError

CONNECT_INTERVAL_S = 0.25
"""Interval of the requests that look for a script."""
MAX_DRAINED = 1000
"""Datagrams that are discarded before a request at most."""
STOP_POLL_S = 0.2
"""Interval at which a wait for a reply checks whether it was stopped."""
GOODBYE_TIMEOUT_S = 0.3
"""Timeout of a script's last reply."""
MAX_DATAGRAM_BYTES = 2**16


class ScriptGoneError(RemoteError):
    """The script's session is over: AI4U's protocol can't recover a lost datagram."""


class AI4UScript:
    """A UDP socket to a script, and the dialogue with it.

    Args:
        port: its UDP port.
        dialogue: with the script.
        host: where it listens.
        patience: seconds for which a script may be silent; see :attr:`patience`.
        is_over: set by another thread to stop waiting for replies.

    Raises:
        RemoteError: there is no such host.
    """

    def __init__(
        self,
        port: int,
        dialogue: AI4UDialogue,
        *,
        host: str = "127.0.0.1",
        patience: float = 5.0,
        is_over: threading.Event | None = None,
    ) -> None:
        self.where = f"{host}:{port}"
        self.dialogue = dialogue
        self.ignored = 0
        """Datagrams that were no answer."""
        self.is_over = is_over or threading.Event()
        self.patience = patience
        """Seconds for which a script may be silent; counts from the next request on."""
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))  # so that nobody else is heard
        except OSError as error:
            self._socket.close()
            raise RemoteError(
                _(
                    "expected the name or address of this machine, got {host!r} ({problem})",
                    host=host,
                    problem=str(error),
                )
            ) from None
        if sys.platform == "win32":  # there each later datagram would raise for an earlier refusal
            self._socket.ioctl(0x9800000C, False)

    def ask(self, state: SentState | None = None) -> AI4UReply | None:
        """Send the next request, and wait for the reply.

        Only requests that look for a script are repeated: the script would take a repeated datagram
        for the next one.

        Returns:
            The reply; None if no script answers yet, or the wait was stopped.

        Raises:
            ScriptGoneError: a script that was connected does not reply.
        """
        dialogue = self.dialogue
        is_connecting = dialogue.phase is SessionPhase.CONNECTING
        self._drain()
        until = time.monotonic() + (CONNECT_INTERVAL_S if is_connecting else self.patience)
        try:
            self._socket.send(dialogue.request(state))
            while (left := until - time.monotonic()) > 0:
                self._socket.settimeout(min(left, STOP_POLL_S))
                try:
                    return dialogue.parse_reply(self._socket.recv(MAX_DATAGRAM_BYTES))
                except WireError:
                    self.ignored += 1
                except TimeoutError:
                    pass
                if self.is_over.is_set():
                    return None
            error: OSError = TimeoutError(_("no answer for {patience:g} s", patience=self.patience))
        except OSError as failed:
            error = failed
        dialogue.begin()
        if is_connecting:
            time.sleep(max(0.0, until - time.monotonic()))
            return None
        raise ScriptGoneError(
            _(
                "the AI4U script at {where} is gone ({problem}); start it again",
                where=self.where,
                problem=str(error),
            )
        )

    def say_goodbye(self) -> None:
        """Tell a script that the world has ended."""
        if self.dialogue.phase not in (SessionPhase.CONNECTING, SessionPhase.OVER):
            with contextlib.suppress(OSError):
                self._socket.send(self.dialogue.goodbye_request())
                self._socket.settimeout(GOODBYE_TIMEOUT_S)
                self._socket.recv(MAX_DATAGRAM_BYTES)
        self.dialogue.begin()

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    def _drain(self) -> None:
        """Discard what arrived before a request: it can't be the reply."""
        self._socket.settimeout(0.0)
        for _number in range(MAX_DRAINED):
            try:
                self._socket.recv(MAX_DATAGRAM_BYTES)
                self.ignored += 1
            except BlockingIOError:
                return
            except OSError:
                continue  # an earlier datagram reached nobody; the next one will tell
