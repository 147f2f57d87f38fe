"""No test depends on the speed of its machine without a reason beside it."""

from tests.real_time import TESTS, check_paths


def test_what_uses_real_time_says_why() -> None:
    assert check_paths([TESTS]) == []
