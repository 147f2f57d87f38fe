"""viser's server as we run it: on loopback, silent, and never shared with the internet."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import rich
from viser import ViserServer

from ai4u_edu.viewer.backend.broadcast import fan_out
from ai4u_edu.viewer.backend.incoming import IncomingMessages


class LocalServer(ViserServer):
    """A viser server that only this machine can reach.

    viser lets any page ask for a public address, whether or not it shows the button: its handlers
    call the two methods below. They do nothing here, so there is no way left to open a tunnel.

    Args:
        label: what the panel is called.
    """

    def __init__(self, label: str) -> None:
        # a page may go while it is being written to; that is no news
        warnings.filterwarnings("ignore", r"Queued a \w+ on a closed connection")
        with quiet():
            super().__init__(host="127.0.0.1", port=0, label=label, verbose=False)
        fan_out(self)
        IncomingMessages(self)

    def request_share_url(self, verbose: bool = True) -> str | None:  # noqa: ARG002
        """Refuses."""
        return None

    def disconnect_share_url(self) -> None:
        """There is nothing to disconnect."""

    def stop(self) -> None:
        """Stops the server and its threads."""
        with quiet():
            super().stop()


@contextmanager
def quiet() -> Iterator[None]:
    """Keeps viser's notices, printed with rich, off the terminal."""
    console = rich.get_console()
    before, console.quiet = console.quiet, True
    try:
        yield
    finally:
        console.quiet = before
