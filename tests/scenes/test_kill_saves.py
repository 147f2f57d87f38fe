"""A short slice of ``python -m tests.scenes.kill_saves``."""

import pytest

from tests.scenes.kill_saves import run


@pytest.mark.slow
def test_a_scene_is_never_half_written() -> None:
    assert run(3) == []
