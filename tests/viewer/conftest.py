"""A viewer whose world stands still until a test moves it."""

from collections.abc import Iterator

import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from tests.editing.harness import EditorHarness
from tests.viewer.worlds import busy_sim


@pytest.fixture
def runner() -> Runner:
    return Runner(busy_sim(), seed=1)


@pytest.fixture
def viewer(runner: Runner) -> Iterator[Viewer]:
    viewer = Viewer(runner)
    yield viewer
    viewer.stop()


@pytest.fixture
def harness() -> Iterator[EditorHarness]:
    harness = EditorHarness()
    harness.runner.pause()
    harness.runner.start()
    yield harness
    harness.runner.stop()
