"""Calls for another thread's loop: in order, none lost, few wake-ups."""

import asyncio
import threading

import pytest

from ai4u_edu.page.server.loop_queue import MAX_CALLS_AT_ONCE, LoopQueue
from tests.waiting import LIMIT_S, until_async


def test_a_hundred_calls_wake_the_loop_once(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[object] = []
    wakes = 0

    async def main() -> None:
        loop, queue = asyncio.get_running_loop(), LoopQueue()
        assert queue.is_running_loop()
        wake = loop.call_soon_threadsafe

        def counted(*arguments: object) -> object:
            nonlocal wakes
            wakes += 1
            return wake(*arguments)  # type: ignore[arg-type]

        monkeypatch.setattr(loop, "call_soon_threadsafe", counted)

        def add_calls() -> None:
            for number in range(100):
                queue.call(done.append, number)

        thread = threading.Thread(target=add_calls)
        thread.start()
        thread.join()  # the loop has no turn meanwhile
        assert done == []
        assert wakes == 1
        await asyncio.sleep(0)
        assert len(done) == MAX_CALLS_AT_ONCE  # then it is another one's turn
        while len(done) < 100:
            await asyncio.sleep(0)

    asyncio.run(main())
    assert done == list(range(100))
    assert wakes == 1


def test_a_call_from_the_loop_itself_is_made_at_once_but_not_before_earlier_ones() -> None:
    done: list[object] = []

    async def main() -> None:
        queue = LoopQueue()
        queue.call(done.append, "at once")
        assert done == ["at once"]
        thread = threading.Thread(target=queue.call, args=(done.append, "first"))
        thread.start()
        thread.join()
        queue.call(done.append, "then")
        assert done == ["at once"]
        await until_async(lambda: len(done) == 3)

    asyncio.run(main())
    assert done == ["at once", "first", "then"]


def test_no_call_from_many_threads_is_lost() -> None:
    done: list[tuple[int, int]] = []

    async def main() -> None:
        queue = LoopQueue()

        def add_calls(who: int) -> None:
            for number in range(2000):
                queue.call(done.append, (who, number))

        threads = [threading.Thread(target=add_calls, args=(who,)) for who in range(4)]
        for each in threads:
            each.start()
        async with asyncio.timeout(LIMIT_S):
            while len(done) < 8000:
                await asyncio.sleep(0)

    asyncio.run(main())
    for who in range(4):
        assert [number for thread, number in done if thread == who] == list(range(2000))


def test_a_call_that_fails_stops_no_other_one() -> None:
    done: list[object] = []
    failed: list[object] = []

    def fail(argument: object) -> None:
        raise ValueError(argument)

    async def main() -> None:
        loop, queue = asyncio.get_running_loop(), LoopQueue()
        loop.set_exception_handler(lambda _, context: failed.append(context["exception"]))

        def add_calls() -> None:
            queue.call(fail, "oh")
            queue.call(done.append, "next")

        thread = threading.Thread(target=add_calls)
        thread.start()
        thread.join()
        await until_async(lambda: done)

    asyncio.run(main())
    assert done == ["next"]
    assert isinstance(failed[0], ValueError)
