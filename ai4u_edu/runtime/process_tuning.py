"""Settings of a Python process that does nothing but run one world, or serve a class.

They hold for the whole process, so only a command that owns its process may use them: a library
object that did would change the program of whoever uses it.
"""

import ctypes
import gc
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

SWITCH_INTERVAL_S = 0.0002
"""Time after which a thread that computes lets another one run. With Python's default of 5 ms, a
tick is late whenever pages are drawn."""
NEW_OBJECTS_BEFORE_GC = 10_000
"""New container objects after which the garbage collector runs: many times what a picture
needs."""
COLLECTIONS_BEFORE_OLDER = 1
"""Collections of one generation before the next older one is collected too. Worlds of past episodes
are few objects in cycles with much memory behind them; with Python's default of 10 they would stay
for hours (0.3 MB an episode), and closed connections of a class likewise (30 MB an hour). A full
collection takes 2 ms here, since most objects are frozen."""
RELEASE_EVERY_S = 60.0
"""Period at which a server of many connections gives free memory back."""
M_ARENA_MAX, M_MMAP_THRESHOLD, M_TRIM_THRESHOLD = -8, -3, -1
"""glibc's numbers of three settings: how many heaps the threads of a process share, the size from
which on a block may lie outside them, and how much may be free at a heap's end."""
MMAP_THRESHOLD_BYTES, TRIM_THRESHOLD_BYTES = 128 * 1024, 1024 * 1024


@contextmanager
def tuned_process() -> Iterator[None]:
    """Tune thread switches and garbage collection for ticks on time; restore both at the end.

    A full collection looks at every object while no other thread runs. Nearly all objects that are
    there when this is called stay to the end, so they are frozen: no collection looks at them.
    Where some were frozen before, all stay frozen: the collector can't tell them apart.
    """
    interval, thresholds = sys.getswitchinterval(), gc.get_threshold()
    had_frozen = gc.get_freeze_count() > 0
    sys.setswitchinterval(min(interval, SWITCH_INTERVAL_S))
    gc.set_threshold(NEW_OBJECTS_BEFORE_GC, COLLECTIONS_BEFORE_OLDER, COLLECTIONS_BEFORE_OLDER)
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        if not had_frozen:
            gc.unfreeze()
        gc.set_threshold(*thresholds)
        sys.setswitchinterval(interval)


@contextmanager
def released_memory() -> Iterator[None]:
    """Collect garbage and give free memory back to the system, every minute.

    asyncio receives into 256 KiB at a time, of which a message keeps a little. Between such rests
    fewer and fewer gaps are large enough for that, so that a class's memory would grow by 30 MB an
    hour. So no heap grows for a block of this size: where none has room for it, it lies outside.
    glibc would begin so, but takes the size of each such block that is freed for its new limit.

    glibc gives most threads a heap of their own; each of them keeps gaps that the others can't use,
    so that a room in which somebody edits would grow to twice its size. Python's threads run one at
    a time, and hardly ever wait for each other at a common heap.
    """
    stopping = threading.Event()
    mallopt = _glibc("mallopt")
    mallopt(M_ARENA_MAX, 1)
    mallopt(M_MMAP_THRESHOLD, MMAP_THRESHOLD_BYTES)
    mallopt(M_TRIM_THRESHOLD, TRIM_THRESHOLD_BYTES)
    trim = _glibc("malloc_trim")

    def run() -> None:
        while not stopping.wait(RELEASE_EVERY_S):
            gc.collect()
            trim(0)

    thread = threading.Thread(target=run, name="memory release", daemon=True)
    thread.start()
    try:
        yield
    finally:
        stopping.set()
        thread.join()


def _glibc(name: str) -> Callable[..., object]:
    """Return a function of glibc; elsewhere one that does nothing."""
    found = getattr(ctypes.CDLL(None), name, None) if sys.platform == "linux" else None
    return found or (lambda *_: None)
