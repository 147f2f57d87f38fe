"""An AI4U script on this machine, as a world sees it: asked over UDP, one thing at a time."""

import contextlib
import socket
import sys
import threading
import time

from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, AI4UReply, Phase, State
from ai4u_edu.wire.validation import WireError

KNOCK_EVERY = 0.25
"""Seconds between two knocks while no script is there."""
MOST_DRAINED = 1000
"""Datagrams thrown away before a request, at most."""
LISTENING = 0.2
"""Seconds after which whoever waits for a reply looks whether the script is still wanted."""
FAREWELL = 0.3
"""Seconds for which a script's last reply is waited for."""


class ScriptGoneError(RemoteError):
    """The script's session is over: AI4U's protocol can't make up for what is lost."""


class AI4UScript:
    """The way to a script at a UDP port.

    Args:
        port: its UDP port.
        dialogue: what is said when.
        host: where it listens.
        patience: seconds for which a script may be silent.
        is_over: set by another thread when no script is wanted any more: then nobody waits for
            this one.

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
        self._patience = patience
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect((host, port))  # so that nobody else is heard
        except OSError as error:
            self._socket.close()
            raise RemoteError(
                f"expected the name or address of this machine, got {host!r} ({error})"
            ) from None
        if sys.platform == "win32":  # there a refusal would be told of every later datagram
            self._socket.ioctl(0x9800000C, False)

    def ask(self, state: State | None = None) -> AI4UReply | None:
        """Says what is due, and waits for the reply.

        Nothing is ever said twice, other than knocks: the script would take one more for the next.

        Returns:
            The reply; None if nobody opens yet, or the script is not wanted any more.

        Raises:
            ScriptGoneError: there is no reply.
        """
        dialogue = self.dialogue
        knocks = dialogue.phase is Phase.CONNECTING
        self._drain()
        until = time.monotonic() + (KNOCK_EVERY if knocks else self._patience)
        try:
            self._socket.send(dialogue.request(state))
            while (left := until - time.monotonic()) > 0:
                self._socket.settimeout(min(left, LISTENING))
                try:
                    return dialogue.parse_reply(self._socket.recv(2**16))
                except WireError:
                    self.ignored += 1
                except TimeoutError:
                    pass
                if self.is_over.is_set():
                    return None
            error: OSError = TimeoutError(f"no answer for {self._patience:g} s")
        except OSError as failed:
            error = failed
        dialogue.begin()
        if knocks:
            time.sleep(max(0.0, until - time.monotonic()))
            return None
        raise ScriptGoneError(f"the AI4U script at {self.where} is gone ({error}); start it again")

    def say_goodbye(self) -> None:
        """Tells a script that the world has ended."""
        if self.dialogue.phase not in (Phase.CONNECTING, Phase.OVER):
            with contextlib.suppress(OSError):
                self._socket.send(self.dialogue.goodbye_request())
                self._socket.settimeout(FAREWELL)
                self._socket.recv(2**16)
        self.dialogue.begin()

    def close(self) -> None:
        """Closes the socket."""
        self._socket.close()

    def _drain(self) -> None:
        """What came before a request is no reply to it."""
        self._socket.settimeout(0.0)
        for _ in range(MOST_DRAINED):
            try:
                self._socket.recv(2**16)
                self.ignored += 1
            except BlockingIOError:
                return
            except OSError:
                continue  # a datagram of before found nobody; the next one will tell
