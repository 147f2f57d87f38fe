"""Turns of join codes that come from an address with too many wrong ones."""

import asyncio

from ai4u_edu.page.server.limits.attempts import (
    CODE_TURNS_PER_S,
    FORGOTTEN_PER_S,
    MAX_CODE_WAIT_S,
    MAX_WRONG,
    CodeLimit,
)


class Queue:
    """A limit whose clock stands still, and which notes how long each code would wait."""

    def __init__(self) -> None:
        self.now = 100.0
        self.waits: list[float] = []
        self.limit = CodeLimit(lambda: self.now, self._sleep)

    async def _sleep(self, seconds: float) -> None:
        self.waits.append(seconds)

    def takes(self, address: str) -> bool:
        return asyncio.run(self.limit.wait_for_turn(address))

    def add_wrong(self, address: str, count: int) -> None:
        for _ in range(count):
            self.limit.add_wrong(address)


def test_codes_wait_for_turns_after_too_many_wrong_ones_of_their_address() -> None:
    queue = Queue()
    queue.add_wrong("school", MAX_WRONG - 1)
    assert queue.takes("school")
    assert queue.waits == []
    queue.add_wrong("school", 1)
    for _ in range(3):
        assert queue.takes("school")
    assert queue.takes("home")
    assert [round(each * CODE_TURNS_PER_S) for each in queue.waits] == [1, 2, 3]


def test_a_code_that_would_wait_too_long_is_refused() -> None:
    queue = Queue()
    queue.add_wrong("school", MAX_WRONG)
    turns = [queue.takes("school") for _ in range(round(MAX_CODE_WAIT_S * CODE_TURNS_PER_S) + 2)]
    assert turns.count(False) in (2, 3)  # of rounding
    assert turns[-2:] == [False, False]
    assert max(queue.waits) <= MAX_CODE_WAIT_S
    queue.now += 1
    assert queue.takes("school")


def test_wrong_codes_are_forgotten() -> None:
    queue = Queue()
    queue.add_wrong("school", MAX_WRONG)
    queue.now += 1 / FORGOTTEN_PER_S
    assert queue.takes("school")
    assert queue.waits == []
