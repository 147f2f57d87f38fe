"""Waits that end in time, and those that somebody else ends."""

import asyncio
from collections.abc import Coroutine

import pytest

from ai4u_edu.remote.limit import Limit

FOREVER = 60.0
"""Seconds, longer than a test may take."""


def run(wait: Coroutine[None, None, None]) -> None:
    asyncio.run(asyncio.wait_for(wait, 10.0))


def test_a_wait_in_vain_ends_and_the_task_goes_on() -> None:
    async def main() -> None:
        limit, task = Limit(), asyncio.current_task()
        assert task is not None
        for _ in range(3):
            with pytest.raises(TimeoutError), limit.of(0.01):
                await asyncio.sleep(FOREVER)
        assert not task.cancelling()
        await asyncio.sleep(0.01)

    run(main())


def test_one_timer_serves_many_waits_and_then_the_last_has_its_full_time() -> None:
    async def main() -> None:
        limit, loop = Limit(), asyncio.get_running_loop()
        for _ in range(5):
            with limit.of(0.05):
                await asyncio.sleep(0.02)
        began = loop.time()
        with pytest.raises(TimeoutError), limit.of(0.05):
            await asyncio.sleep(FOREVER)
        assert loop.time() - began >= 0.05 - 0.001  # the clock's own grain

    run(main())


def test_a_shorter_wait_after_a_longer_one_ends_in_its_own_time() -> None:
    async def main() -> None:
        limit = Limit()
        with limit.of(FOREVER):
            await asyncio.sleep(0)
        with pytest.raises(TimeoutError), limit.of(0.01):
            await asyncio.sleep(FOREVER)

    run(main())


def test_what_happens_after_a_wait_has_no_limit() -> None:
    async def main() -> None:
        limit = Limit()
        with limit.of(0.01):
            await asyncio.sleep(0)
        await asyncio.sleep(0.05)

    run(main())


def test_who_is_cancelled_by_another_is_cancelled() -> None:
    async def main() -> None:
        limit = Limit()

        async def wait() -> None:
            with limit.of(FOREVER):
                await asyncio.sleep(FOREVER)

        task = asyncio.create_task(wait())
        await asyncio.sleep(0.01)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    run(main())


def test_a_limit_around_it_may_be_the_shorter() -> None:
    async def main() -> None:
        async def wait() -> None:
            with Limit().of(FOREVER):
                await asyncio.sleep(FOREVER)

        with pytest.raises(TimeoutError):
            await asyncio.wait_for(wait(), 0.01)

    run(main())


def test_cancelled_in_the_very_moment_in_which_time_is_up() -> None:
    async def main() -> None:
        limit = Limit()

        async def wait() -> None:
            with limit.of(FOREVER):
                await asyncio.sleep(FOREVER)

        task = asyncio.create_task(wait())
        await asyncio.sleep(0.01)
        limit.of(0.0)
        limit._ring()
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    run(main())
