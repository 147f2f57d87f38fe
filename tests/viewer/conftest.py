"""A viewer whose world stands still until a test moves it."""

from collections.abc import Iterator

import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from tests.editing.harness import EditorHarness
from tests.viewer.worlds import busy_sim
from tests.waiting import LIMIT_S


@pytest.fixture
def runner() -> Iterator[Runner]:
    runner = Runner(busy_sim(), seed=1)
    yield runner
    runner.stop(LIMIT_S)  # if a test has started it


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
    harness.runner.stop(LIMIT_S)
