"""Time limits of scripts that no busy machine reaches."""

import pytest

from ai4u_edu.remote import dialogue
from ai4u_edu.remote.connection_options import OPTIONS
from tests.waiting import LIMIT_S


@pytest.fixture(autouse=True)
def _patient_scripts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let scripts wait for a world's answers as long as tests do.

    A script that connects again is another one for some tests. The patience of the whole is an
    argument of ``connect``; see :func:`tests.remote.rooms.connect`.
    """
    monkeypatch.setattr(dialogue, "ATTEMPT_TIMEOUT_S", LIMIT_S)
    monkeypatch.setitem(OPTIONS, "ping_timeout", LIMIT_S)
