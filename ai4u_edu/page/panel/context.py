"""The running world that all pages' panels share."""

import asyncio
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import catalogue
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.messages import to_json
from ai4u_edu.page.panel.page_view import Pictures
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts
from ai4u_edu.recording import Ghosts
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot

T = TypeVar("T")

MAX_CACHED = 200
"""Most texts that a cache holds; it is emptied then."""


class PartCache:
    """JSON texts of parts, so that pages in one language that look at the same thing share them.

    Belongs to the server's event loop.
    """

    def __init__(self) -> None:
        self._snapshot: Snapshot | None = None
        self._of_snapshot: dict[object, bytes] = {}
        self._shared: dict[Callable[[Snapshot], Any], Any] = {}
        self._by_key: dict[object, bytes] = {}

    def of_snapshot(self, snapshot: Snapshot, key: object, build: Callable[[], object]) -> bytes:
        """Return a part of a snapshot; it is kept until the next snapshot."""
        self._follow(snapshot)
        return _cached(self._of_snapshot, key, build)

    def shared(self, snapshot: Snapshot, build: Callable[[Snapshot], T]) -> T:
        """Return a value that several parts of a snapshot contain; it is kept likewise.

        Args:
            snapshot: the snapshot.
            build: makes the value; the same function for each of these parts.
        """
        self._follow(snapshot)
        if build not in self._shared:
            self._shared[build] = build(snapshot)
        value: T = self._shared[build]
        return value

    def by_key(self, key: object, build: Callable[[], object]) -> bytes:
        """Return a part that does not change while its key is the same."""
        return _cached(self._by_key, key, build)

    def _follow(self, snapshot: Snapshot) -> None:
        """Forget what belongs to an earlier snapshot."""
        if snapshot is not self._snapshot:
            self._snapshot, self._of_snapshot, self._shared = snapshot, {}, {}


@dataclass(frozen=True)
class PanelContext:
    """The running world and what belongs to it, for parts and commands.

    Args:
        runner: runs the world.
        pictures: the pages' pictures of it.
        player: plays its recorded episodes.
        ghosts: recorded episodes to race against.
        editor: changes it; None if it can only be watched and driven.
        timeouts: time limits of a replay's frames and of uploads.
    """

    runner: Runner
    pictures: Pictures
    player: ReplayPlayer
    ghosts: Ghosts
    editor: SceneEditor | None = None
    timeouts: Timeouts = DEFAULT_TIMEOUTS
    cache: PartCache = field(default_factory=PartCache)
    slow_work: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(1))
    """Held by a page whose command does slow work in another thread."""
    look: asyncio.Lock = field(default_factory=asyncio.Lock)
    """Held by the page that looks for changed parts; see :meth:`page_turn`."""
    clock: Callable[[], float] = time.monotonic
    began: float = field(default_factory=time.monotonic)
    """Time (s) of the clock from which periods count; see :meth:`until_next_look`."""

    def until_next_look(self, period: float) -> float:
        """Return the time (s) until all pages look for changed parts, once in a period (s).

        Pages of one world look at the same moments, so that they share what was made for one.
        Worlds in other processes have other moments: else a class's rooms would all look at once.
        """
        return period - (self.clock() - self.began) % period

    @asynccontextmanager
    async def page_turn(self) -> AsyncIterator[None]:
        """Let one page look for changed parts, then the loop's other work, then the next page.

        All pages look at the same moments, and asyncio runs all tasks whose time has come in a row.
        With thirty pages that each show another agent, percepts of scripts would wait for them all.
        """
        async with self.look:
            yield
            await asyncio.sleep(0)

    def required_editor(self) -> SceneEditor:
        """Return the editor.

        Raises:
            SetupError: there is none.
        """
        if self.editor is None:
            raise SetupError(_("this world can be watched and driven here, but not changed"))
        return self.editor


def _cached(texts: dict[object, bytes], key: object, build: Callable[[], object]) -> bytes:
    key = catalogue().language, key
    text = texts.get(key)
    if text is None:
        if len(texts) >= MAX_CACHED:
            texts.clear()
        text = texts[key] = to_json(build())
    return text
