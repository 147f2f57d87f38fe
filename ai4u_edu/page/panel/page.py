"""One page as commands see it: the world, what the page looks at, and how to answer it."""

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Literal, TypeVar

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.proposals import NewThing
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.panel.upload import Upload
from ai4u_edu.page.server.loop_queue import result_of

T = TypeVar("T")
Level = Literal["info", "error"]


@dataclass(frozen=True)
class Page:
    """One page. Belongs to the server's event loop.

    Args:
        context: the running world.
        view: what the page looks at.
        note: sends the page a note that answers no command.
        upload: the file that the page is sending.
        moves: held while a thing is moved from where it is.
        clipboard: copies of things, to be pasted.
    """

    context: PanelContext
    view: PageView
    note: Callable[[Level, str], None]
    upload: Upload = field(default_factory=Upload)
    moves: asyncio.Lock = field(default_factory=asyncio.Lock)
    clipboard: list[NewThing] = field(default_factory=list)

    async def in_thread(self, work: Callable[[], T]) -> T:
        """Do slow work in another thread; all pages' work is done one after another."""
        async with self.context.slow_work:
            return await asyncio.to_thread(work)

    async def result(self, future: "Future[T]") -> T:
        """Wait for a result of the runner; it does what was asked for also if the page leaves."""
        stall = self.context.runner.stall
        if stall is not None and not future.done():
            self.note(
                "info",
                _(
                    "That has to wait: {stall}. If it never answers, end the server.",
                    stall=str(stall),
                ),
            )
        return await result_of(future)
