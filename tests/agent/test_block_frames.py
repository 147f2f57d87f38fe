"""Frames of another thread are looked at while no garbage is collected."""

import gc
import sys
import threading
from types import FrameType

import pytest

from ai4u_edu.agent.block_frames import calls_of_thread, find_place, frames_of_thread
from tests.waiting import LIMIT_S


def test_nothing_is_collected_while_frames_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    collects, frames_of_all = [], sys._current_frames

    def current_frames() -> dict[int, FrameType]:
        collects.append(gc.isenabled())
        return frames_of_all()

    monkeypatch.setattr(sys, "_current_frames", current_frames)
    assert frames_of_thread(threading.get_ident())
    assert gc.isenabled()
    gc.disable()
    try:
        assert frames_of_thread(threading.get_ident())
        assert not gc.isenabled()  # it stays as somebody else has chosen
    finally:
        gc.enable()
    assert collects == [False, False]


def test_no_garbage_is_collected_while_variables_of_frames_are_read() -> None:
    """It could let the other thread go on, whose frames would go while they are read."""
    is_running, may_end = threading.Event(), threading.Event()
    collected_in: set[str] = set()

    def hold(calls: int) -> None:
        if calls:
            hold(calls - 1)
        is_running.set()
        may_end.wait(LIMIT_S)

    class Garbage:
        def __init__(self) -> None:
            self.own = self

        def __del__(self) -> None:
            collected_in.add(sys._getframe(1).f_code.co_name)
            if not may_end.is_set():
                Garbage()  # for the next time

    thread = threading.Thread(target=hold, args=[50])
    thread.start()
    thresholds = gc.get_threshold()
    try:
        assert is_running.wait(LIMIT_S)
        calls = calls_of_thread(thread.ident or 0)
        Garbage()
        gc.set_threshold(1, 1, 1)  # at the next objects
        find_place(calls)
    finally:
        gc.set_threshold(*thresholds)
        may_end.set()
        thread.join(LIMIT_S)
    assert collected_in, "garbage was collected before and after"
    assert "_first_argument" not in collected_in
