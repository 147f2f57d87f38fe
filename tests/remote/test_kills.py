"""A short slice of ``python -m tests.remote.kills``."""

import pytest

from tests.remote.kills import run

pytestmark = pytest.mark.slow


def test_a_killed_script_leaves_nothing_behind() -> None:
    # real time: the seat is free once this has passed; who is to resume a session has another limit
    found, wrong = run(2, grace=0.5)
    assert wrong == []
    assert (len(found.stopped), len(found.free), len(found.resumed)) == (2, 1, 1)
