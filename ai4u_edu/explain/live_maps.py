"""Maps over the floor of a running world, beside its ticks, as long as somebody looks at them."""

import math
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

from ai4u_edu.explain.live import INTEREST_S, LiveExplainer
from ai4u_edu.explain.map_maker import LiveMap, MapMaker, MapRequest, SceneOf
from ai4u_edu.explain.pacing import Pacing, StoppedError
from ai4u_edu.snapshot import Snapshot

RUNNING_SHARE = 0.08
"""Share of one processor that maps may take while the world runs."""
PAUSED_SHARE = 0.5
"""The same while it stands still, when no tick can be late."""
IDLE_POLL_S = 0.1
"""Interval at which a map that is complete is compared with the world."""


class MapChoice(NamedTuple):
    """The maps that one page shows."""

    has_field: bool = False
    """True for arrows: what the agent would do at each place."""
    has_values: bool = False
    """True for colours: what each place is worth."""
    facing: str = ""
    """Name of what the agent looks at, as in :class:`MapRequest`."""

    def requests(self, agent: str) -> tuple[MapRequest, ...]:
        """Return the maps of an agent."""
        found = []
        if self.has_values:
            found.append(MapRequest(agent, "values", self.facing))
        if self.has_field:
            found.append(MapRequest(agent, "field", self.facing))
        return tuple(found)


class LiveMaps:
    """Computes maps of a running world in a thread of its own, as long as somebody asks.

    Any thread may call :meth:`ask`; the first call starts the thread, which ends when nobody has
    asked for a while: so a map is cancelled as soon as no page shows it. It works on a copy of the
    world, and pages that show the same map share it.

    Args:
        latest: returns the latest snapshot.
        explainer: knows the agents' policies.
        scene_of: returns the scene in which a snapshot was taken; may wait for the world's thread.
        thrift: factor, 0..1, of the processor time that it may take, for a room among many.
        next_tick_at: as for :class:`~ai4u_edu.explain.pacing.Pacing`.
    """

    def __init__(
        self,
        latest: Callable[[], Snapshot],
        explainer: LiveExplainer,
        scene_of: SceneOf,
        thrift: float = 1.0,
        next_tick_at: Callable[[], float] = lambda: math.inf,
    ) -> None:
        self._latest, self._explainer, self._scene_of = latest, explainer, scene_of
        self._thrift, self._next_tick_at = thrift, next_tick_at
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._stopping = threading.Event()
        self._asked_at: dict[MapRequest, float] = {}
        self._makers: dict[MapRequest, MapMaker] = {}

    def ask(self, request: MapRequest) -> LiveMap | None:
        """Return what is known of a map, and keep computing it for a while.

        Returns:
            None if nothing is known yet.
        """
        with self._lock:
            self._asked_at[request] = time.monotonic()
            if self._thread is None and not self._stopping.is_set():
                self._thread = threading.Thread(target=self._run, name="maps", daemon=True)
                self._thread.start()
            maker = self._makers.get(request)
        return None if maker is None else maker.latest

    def stop(self) -> None:
        """End the thread; it is not waited for, as a student's function may not return."""
        self._stopping.set()

    def _run(self) -> None:
        pacing = Pacing(self._share, self._stopping, self._next_tick_at)
        try:
            while makers := self._wanted(pacing):
                snapshot = self._latest()
                # one place of each in turn, so that a slow map does not hold up another one
                is_busy = [maker.advance(snapshot) for maker in makers]
                pacing.rest()
                if not any(is_busy) and self._stopping.wait(IDLE_POLL_S):
                    return
        except StoppedError:
            return

    def _wanted(self, pacing: Pacing) -> list[MapMaker]:
        """Return the makers of the maps that are looked at; the thread ends if there are none."""
        with self._lock:
            since = time.monotonic() - INTEREST_S
            self._asked_at = {each: at for each, at in self._asked_at.items() if at >= since}
            if not self._asked_at:
                self._thread, self._makers = None, {}
                return []
            self._makers = {
                each: self._makers.get(each)
                or MapMaker(each, self._explainer, self._scene_of, pacing.rest)
                for each in self._asked_at
            }
            return list(self._makers.values())

    def _share(self) -> float:
        share = PAUSED_SHARE if self._latest().paused else RUNNING_SHARE
        return self._thrift * share
