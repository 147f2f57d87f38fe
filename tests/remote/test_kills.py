"""A short slice of ``python -m tests.remote.kills``."""

from tests.remote.kills import run


def test_a_killed_script_leaves_nothing_behind() -> None:
    found, wrong = run(2, grace=0.5)
    assert wrong == []
    assert (len(found.stopped), len(found.free), len(found.resumed)) == (2, 2, 1)
