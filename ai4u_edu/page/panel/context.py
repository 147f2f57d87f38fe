"""The running world that all pages' panels share."""

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field

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

MAX_CACHED = 200
"""Most texts that a cache holds; it is emptied then."""


class PartCache:
    """JSON texts of parts, so that pages in one language that look at the same thing share them.

    Belongs to the server's event loop.
    """

    def __init__(self) -> None:
        self._snapshot: Snapshot | None = None
        self._of_snapshot: dict[object, bytes] = {}
        self._by_key: dict[object, bytes] = {}

    def of_snapshot(self, snapshot: Snapshot, key: object, build: Callable[[], object]) -> bytes:
        """Return a part of a snapshot; it is kept until the next snapshot."""
        if snapshot is not self._snapshot:
            self._snapshot, self._of_snapshot = snapshot, {}
        return _cached(self._of_snapshot, key, build)

    def by_key(self, key: object, build: Callable[[], object]) -> bytes:
        """Return a part that does not change while its key is the same."""
        return _cached(self._by_key, key, build)


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
    clock: Callable[[], float] = time.monotonic
    began: float = field(default_factory=time.monotonic)
    """Time (s) of the clock from which periods count; see :meth:`until_next_look`."""

    def until_next_look(self, period: float) -> float:
        """Return the time (s) until all pages look for changed parts, once in a period (s).

        Pages of one world look at the same moments, so that they share what was made for one.
        Worlds in other processes have other moments: else a class's rooms would all look at once.
        """
        return period - (self.clock() - self.began) % period

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
