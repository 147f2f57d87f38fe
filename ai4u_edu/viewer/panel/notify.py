"""Handing on to the runner what a person asks for, and telling them if it couldn't be done."""

from concurrent.futures import Future
from typing import Any

from viser import ClientHandle

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.stall_monitor import Stall


def notify_failure(client: ClientHandle | None, runner: Runner, future: "Future[Any]") -> None:
    """Tells whoever asked if it couldn't be done, or has to wait for a block that does not return.

    Args:
        client: the page of whoever asked, if there is one.
        runner: carries it out.
        future: what the runner answers.
    """
    notify_stall(client, runner.stall, future)

    def tell(done: "Future[Any]") -> None:
        error = None if done.cancelled() else done.exception()
        if error is not None and client is not None:
            text = message_of(error)
            client.add_notification("That didn't work", text, auto_close_seconds=8.0)

    future.add_done_callback(tell)


def notify_stall(client: ClientHandle | None, stall: Stall | None, future: "Future[Any]") -> None:
    """Tell whoever asked that it has to wait, if something keeps the world from going on."""
    if client is not None and stall is not None and not future.done():
        text = f"{stall}. It is done as soon as that answers; else end the server with Ctrl-C."
        client.add_notification("That has to wait", text, auto_close_seconds=8.0)
