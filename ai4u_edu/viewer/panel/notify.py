"""Notifications on a page about a command that failed or has to wait."""

from concurrent.futures import Future
from typing import Any

from viser import ClientHandle

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.tick_monitor import Stall


def notify_failure(client: ClientHandle | None, runner: Runner, future: "Future[Any]") -> None:
    """Notify a page if its command fails, or has to wait for a block that does not return.

    Args:
        client: the page that sent the command; None if no page did.
        runner: the runner that executes the command.
        future: the command's result.
    """
    notify_stall(client, runner.stall, future)

    def on_done(done: "Future[Any]") -> None:
        error = None if done.cancelled() else done.exception()
        if error is not None and client is not None:
            text = message_of(error)
            client.add_notification("That didn't work", text, auto_close_seconds=8.0)

    future.add_done_callback(on_done)


def notify_stall(client: ClientHandle | None, stall: Stall | None, future: "Future[Any]") -> None:
    """Notify a page that its command has to wait, if the world is stalled."""
    if client is not None and stall is not None and not future.done():
        text = f"{stall}. It is done as soon as that answers; else end the server with Ctrl-C."
        client.add_notification("That has to wait", text, auto_close_seconds=8.0)
