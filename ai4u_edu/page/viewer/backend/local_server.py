"""viser's server on loopback, without output and without public addresses."""

import threading

import rich
from viser import ViserServer
from viser.infra._async_message_buffer import AsyncMessageBuffer

from ai4u_edu.page.viewer.backend.broadcast import install_broadcaster


class _Silence:
    """Suppresses the notices that viser prints with rich, as long as one thread is in it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._wanted = 0
        self._was_quiet = False

    def __enter__(self) -> None:
        console = rich.get_console()
        with self._lock:
            if not self._wanted:
                self._was_quiet, console.quiet = console.quiet, True
            self._wanted += 1

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._wanted -= 1
            if not self._wanted:
                rich.get_console().quiet = self._was_quiet


_SILENCE = _Silence()


class LocalServer(ViserServer):
    """viser server that only this machine can reach.

    viser lets any page ask for a public address: its handlers call the two methods below. They do
    nothing here, so nobody can open a tunnel.

    Args:
        label: title of the panel.
    """

    def __init__(self, label: str) -> None:
        with _SILENCE:
            super().__init__(host="127.0.0.1", port=0, label=label, verbose=False)
        web = self._websock_server
        web.on_client_connect(lambda page: _mute_buffer(page.get_message_buffer()))
        _mute_buffer(web.get_message_buffer())
        install_broadcaster(self)

    def request_share_url(self, verbose: bool = True) -> str | None:  # noqa: ARG002
        """Refuse a public address."""
        return None

    def disconnect_share_url(self) -> None:
        """Do nothing: there is no public address."""

    def stop(self) -> None:
        """Stop the server and its threads."""
        with _SILENCE:
            super().stop()


def _mute_buffer(buffer: AsyncMessageBuffer) -> None:
    """Keep a buffer from warning of a message to a page that has just disconnected."""
    buffer._warned_push_after_done = True
