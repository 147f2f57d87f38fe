"""Process-wide settings: only a command that owns its process changes them."""

import ctypes
import gc
import subprocess
import sys
import weakref
from collections.abc import Iterator

import pytest

from ai4u_edu.cli import main as cli
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.runtime import process_tuning
from ai4u_edu.runtime.process_tuning import (
    NEW_OBJECTS_BEFORE_GC,
    released_memory,
    tuned_process,
)
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim
from tests.waiting import LIMIT_S, until


@pytest.fixture(autouse=True)
def unfrozen() -> Iterator[None]:
    """Undo for a while what the suite froze when it had collected the tests."""
    gc.unfreeze()
    yield
    gc.freeze()


def settings() -> tuple[object, ...]:
    return sys.getswitchinterval(), gc.get_threshold(), gc.get_freeze_count()


def test_a_tuned_process_is_as_it_was_afterwards() -> None:
    before = settings()
    with tuned_process():
        assert sys.getswitchinterval() < 0.001
        assert gc.get_threshold() == (NEW_OBJECTS_BEFORE_GC, 1, 1)
        assert gc.get_freeze_count() > 10_000
    assert settings() == before


def test_what_was_frozen_before_stays_so() -> None:
    gc.freeze()
    with tuned_process():
        pass
    assert gc.get_freeze_count() > 10_000


def test_garbage_goes_though_the_collector_is_off(monkeypatch: pytest.MonkeyPatch) -> None:
    class Cycle:
        def __init__(self) -> None:
            self.own = self

    monkeypatch.setattr(process_tuning, "RELEASE_EVERY_S", 0.01)
    gc.disable()
    try:
        there = weakref.ref(Cycle())
        assert there() is not None
        with released_memory():
            until(lambda: there() is None)
    finally:
        gc.enable()


LARGE_BLOCKS = """
import ctypes
from ai4u_edu.runtime.process_tuning import released_memory
names = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()
class Info(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in names]
mallinfo = ctypes.CDLL(None).mallinfo2
mallinfo.restype = Info
with released_memory():
    before = mallinfo().hblks
    for _ in range(2):
        blocks = None  # the first ones are freed
        blocks = [bytearray(256 * 1024) for _ in range(100)]
    print(mallinfo().hblks - before)
"""
"""Prints how many of 100 large blocks lie outside the heap when as many were freed before."""


@pytest.mark.skipif(
    sys.platform != "linux" or not hasattr(ctypes.CDLL(None), "mallinfo2"),
    reason="glibc tells it from 2.33 on",
)
def test_large_blocks_lie_outside_the_heap_also_when_one_was_freed() -> None:
    done = subprocess.run(
        [sys.executable, "-c", LARGE_BLOCKS],
        capture_output=True,
        text=True,
        check=True,
        timeout=LIMIT_S,
    )
    assert int(done.stdout) > 50, "most: a few may find gaps in the heap"


def test_a_runner_and_a_viewer_change_nothing_of_the_process() -> None:
    before = settings()
    runner = Runner(small_sim(), seed=1)
    viewer = Viewer(runner)
    runner.start()
    viewer.start()
    try:
        assert runner.submit(settings).result(LIMIT_S) == before
    finally:
        viewer.stop()
        runner.stop(LIMIT_S)


def test_play_tunes_its_process_while_it_serves(monkeypatch: pytest.MonkeyPatch) -> None:
    before, during = settings(), []
    monkeypatch.setattr("ai4u_edu.page.server.serve", lambda *_, **__: during.append(settings()))
    cli.app(["play", "--no-open", "--no-autosave"], standalone_mode=False)
    (seen,) = during
    assert all(each != other for each, other in zip(seen, before, strict=True))
    assert settings() == before
