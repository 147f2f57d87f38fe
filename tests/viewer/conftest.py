"""A viewer whose world stands still until a test moves it."""

from collections.abc import Iterator

import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from tests.editing.shops import Shop
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
def shop() -> Iterator[Shop]:
    shop = Shop()
    shop.runner.pause()
    shop.runner.start()
    yield shop
    shop.runner.stop()
