"""A loop that looks out for a while before it sleeps."""

import asyncio
import selectors
import socket

import pytest

from ai4u_edu.server import eager
from ai4u_edu.server.eager import EagerLoop, EagerSelector, look_out


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[float | None]:
    """For how long the system was asked to wait, each time."""
    timeouts: list[float | None] = []
    plain = selectors.DefaultSelector.select

    def select(
        self: selectors.DefaultSelector, timeout: float | None = None
    ) -> list[tuple[selectors.SelectorKey, int]]:
        timeouts.append(timeout)
        return plain(self, timeout)

    monkeypatch.setattr(selectors.DefaultSelector, "select", select)
    return timeouts


def test_it_is_found_without_sleeping(
    asked: list[float | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    here, there = socket.socketpair()
    with here, there, EagerSelector() as selector:
        selector.register(here, selectors.EVENT_READ)
        selector.until = float("inf")
        monkeypatch.setattr(eager, "give_way", lambda: len(asked) == 3 and there.send(b"x"))
        assert [key.fileobj for key, _ in selector.select()] == [here]
    assert asked == [0, 0, 0, 0]


def test_who_has_little_time_is_not_kept(asked: list[float | None]) -> None:
    with EagerSelector() as selector:
        selector.until = float("inf")
        assert selector.select(0.01) == []
        assert asked[-1] == 0.01
        assert set(asked[:-1]) == {0}
        before = len(asked)
        assert selector.select(0) == []
        assert len(asked) - before <= 2


def test_it_sleeps_unless_somebody_is_looked_out_for(asked: list[float | None]) -> None:
    async def main() -> int:
        asked.clear()
        await asyncio.sleep(0.02)
        calm = len(asked)
        look_out()
        asked.clear()
        await asyncio.sleep(0.02)
        assert 0 in asked[:-1]
        return calm

    with asyncio.Runner(loop_factory=EagerLoop) as runner:
        assert runner.run(main()) <= 3


def test_another_loop_just_goes_on() -> None:
    async def main() -> None:
        look_out()

    asyncio.run(main())
