"""Results of commands, without a socket."""

import asyncio
import gc
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.page.panel.page import Page


def test_an_error_for_which_nobody_waits_any_more_is_not_logged() -> None:
    """A page that leaves cancels its commands; the runner carries them out all the same."""
    logged: list[Any] = []
    context: Any = SimpleNamespace(runner=SimpleNamespace(stall=None))
    view: Any = None

    async def leave() -> None:
        asyncio.get_running_loop().set_exception_handler(lambda _, what: logged.append(what))
        result: Future[None] = Future()
        command = asyncio.create_task(Page(context, view, lambda *_: None).result(result))
        await asyncio.sleep(0)
        command.cancel()
        await asyncio.gather(command, return_exceptions=True)
        result.set_exception(SetupError("expected a thing"))
        for _ in range(3):
            await asyncio.sleep(0)
        del result, command
        gc.collect()

    asyncio.run(leave())
    assert logged == []
