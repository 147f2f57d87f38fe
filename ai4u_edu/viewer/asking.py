"""Handing on to the runner what a person asks for, and telling them if it couldn't be done."""

from concurrent.futures import Future
from typing import Any

from viser import ClientHandle


def ask(client: ClientHandle | None, future: "Future[Any]") -> None:
    """Tells whoever asked if it couldn't be done.

    Args:
        client: the page of whoever asked, if there is one.
        future: what the runner answers.
    """

    def tell(done: "Future[Any]") -> None:
        error = None if done.cancelled() else done.exception()
        if error is not None and client is not None:
            client.add_notification("That didn't work", str(error), auto_close_seconds=8.0)

    future.add_done_callback(tell)
