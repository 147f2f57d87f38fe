"""Watch of a world's page, which tells when nobody looks any more."""

import threading
from collections.abc import Callable

GONE_S = 60.0
"""Time without a page after which a world ends; a reload or a short sleep takes less."""
GONE_AT_HUB_S = 300.0
"""The same at a JupyterHub: pages are gone, too, while the hub and its proxy are restarted."""
POLL_S = 1.0


class PageWatch:
    """Thread that calls a function once a page was open, and then none is for a while.

    Args:
        count: returns the number of open pages; called from the thread.
        gone: called once, from the thread.
        gone_s: time without a page, seconds.
        poll_s: interval of the counts, seconds.
    """

    def __init__(
        self,
        count: Callable[[], int],
        gone: Callable[[], object],
        gone_s: float = GONE_S,
        poll_s: float = POLL_S,
    ) -> None:
        self._count, self._gone = count, gone
        self._gone_s, self._poll_s = gone_s, poll_s
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="page-watch", daemon=True)

    def start(self) -> None:
        """Begin to count."""
        self._thread.start()

    def stop(self) -> None:
        """Stop counting; the function is not called any more."""
        self._stopped.set()

    def _watch(self) -> None:
        was_open, empty = False, 0
        while not self._stopped.wait(self._poll_s):
            # counts and not a clock: a computer that slept has not waited
            empty = 0 if self._count() else empty + 1
            was_open = was_open or not empty
            if was_open and empty * self._poll_s > self._gone_s:
                self._gone()
                return
