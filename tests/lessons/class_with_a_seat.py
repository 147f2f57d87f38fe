"""A tiny class that a notebook joins without HTTP."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import pytest

from ai4u_edu.lessons.class_membership import current_connection
from ai4u_edu.member import Seat, SeatFile, notebook
from ai4u_edu.member.notebook import ClassConnection
from tests.member.tiny_class import PATIENT, SECRET, TinyClass
from tests.waiting import until


@contextmanager
def class_with_a_seat(
    monkeypatch: pytest.MonkeyPatch, clock: Callable[[], float] = time.monotonic
) -> Iterator[TinyClass]:
    """Gives a class to whoever joins; a test starts it.

    Args:
        clock: of the notebook's connection.
    """
    there = TinyClass()
    seat = Seat(SECRET, "Red Fox", "#d55e00", there.url)
    monkeypatch.setattr(SeatFile, "take", lambda *_: seat)
    patient = partial(ClassConnection, timeouts=PATIENT, clock=clock)
    monkeypatch.setattr(notebook, "ClassConnection", patient)
    yield there
    there.stop()


def connected() -> ClassConnection:
    """Wait until the notebook is connected with its class; return the connection."""
    connection = current_connection()
    assert connection is not None
    until(lambda: connection.client.is_connected)
    return connection
