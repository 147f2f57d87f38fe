"""A tiny class that a notebook joins without HTTP."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from ai4u_edu.class_link import Seat, SeatFile
from tests.class_link.tiny_class import SECRET, TinyClass
from tests.server.rooms import free_port


@contextmanager
def class_with_a_seat(monkeypatch: pytest.MonkeyPatch) -> Iterator[TinyClass]:
    """Gives a class to whoever joins; a test starts it."""
    there = TinyClass()
    there.port = free_port()
    seat = Seat(SECRET, "Red Fox", "#d55e00", there.url)
    monkeypatch.setattr(SeatFile, "take", lambda *_: seat)
    yield there
    there.stop()
