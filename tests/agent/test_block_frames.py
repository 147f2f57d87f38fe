"""Frames of another thread are looked at while no garbage is collected."""

import gc
import sys
import threading
from types import FrameType

import pytest

from ai4u_edu.agent.block_frames import frames_of_thread


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
