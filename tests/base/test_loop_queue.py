"""Errands for another thread's loop: in order, all of them, and with few wake-ups."""

import asyncio
import threading

import pytest

from ai4u_edu.base.loop_queue import AT_ONCE, Post


def test_a_hundred_errands_wake_the_loop_once(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[object] = []
    wakes = 0

    async def main() -> None:
        loop, post = asyncio.get_running_loop(), Post()
        assert post.is_here()
        wake = loop.call_soon_threadsafe

        def counted(*arguments: object) -> object:
            nonlocal wakes
            wakes += 1
            return wake(*arguments)  # type: ignore[arg-type]

        monkeypatch.setattr(loop, "call_soon_threadsafe", counted)

        def give() -> None:
            for number in range(100):
                post.give(done.append, number)

        giver = threading.Thread(target=give)
        giver.start()
        giver.join()  # the loop has no turn meanwhile
        assert done == []
        assert wakes == 1
        await asyncio.sleep(0)
        assert len(done) == AT_ONCE  # then it is another one's turn
        while len(done) < 100:
            await asyncio.sleep(0)

    asyncio.run(main())
    assert done == list(range(100))
    assert wakes == 1


def test_what_is_given_in_the_loop_is_done_at_once_but_not_before_others() -> None:
    done: list[object] = []

    async def main() -> None:
        post = Post()
        post.give(done.append, "at once")
        assert done == ["at once"]
        giver = threading.Thread(target=post.give, args=(done.append, "first"))
        giver.start()
        giver.join()
        post.give(done.append, "then")
        assert done == ["at once"]
        await asyncio.sleep(0.01)

    asyncio.run(main())
    assert done == ["at once", "first", "then"]


def test_from_many_threads_while_the_loop_runs_nothing_is_lost() -> None:
    done: list[tuple[int, int]] = []

    async def main() -> None:
        post = Post()

        def give(who: int) -> None:
            for number in range(2000):
                post.give(done.append, (who, number))

        givers = [threading.Thread(target=give, args=(who,)) for who in range(4)]
        for each in givers:
            each.start()
        async with asyncio.timeout(20):
            while len(done) < 8000:
                await asyncio.sleep(0)

    asyncio.run(main())
    for who in range(4):
        assert [number for giver, number in done if giver == who] == list(range(2000))


def test_an_errand_that_fails_stops_no_other_one() -> None:
    done: list[object] = []
    failed: list[object] = []

    def fail(argument: object) -> None:
        raise ValueError(argument)

    async def main() -> None:
        loop, post = asyncio.get_running_loop(), Post()
        loop.set_exception_handler(lambda _, context: failed.append(context["exception"]))

        def give() -> None:
            post.give(fail, "oh")
            post.give(done.append, "next")

        giver = threading.Thread(target=give)
        giver.start()
        giver.join()
        await asyncio.sleep(0.01)

    asyncio.run(main())
    assert done == ["next"]
    assert isinstance(failed[0], ValueError)
