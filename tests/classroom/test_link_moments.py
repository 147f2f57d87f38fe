"""Moments of a link that a socket alone can't bring about."""

import asyncio
from typing import Any

from ai4u_edu.classroom.link_endpoint import LinkEndpoint
from ai4u_edu.classroom.live_rooms import LiveRoom
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit
from ai4u_edu.wire.class_link import VERSION, LinkHello, encode_from_room
from tests.waiting import until_async

SCOPE: dict[str, Any] = {"type": "websocket", "subprotocols": [], "headers": [], "path": "/"}


def test_a_cancellation_that_comes_with_the_hello_ends_the_link() -> None:
    """Python 3.11 loses it in ``asyncio.wait_for``."""

    async def find_room(secret: str, address: str) -> LiveRoom | None:
        await asyncio.Event().wait()
        return None

    async def run() -> None:
        hello: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        is_asked = asyncio.Event()

        messages = iter([{"type": "websocket.connect"}])

        async def receive() -> Any:
            if (message := next(messages, None)) is not None:
                return message
            is_asked.set()
            return await hello

        async def send(_: Any) -> None:
            pass

        nothing: Any = None
        limit = ConcurrencyLimit(10, 1.0)
        endpoint = LinkEndpoint(nothing, limit, limit, find_room)
        task = asyncio.create_task(endpoint(SCOPE, receive, send))
        await is_asked.wait()
        frame = encode_from_room(LinkHello(VERSION, "secret", "room"))
        hello.set_result({"type": "websocket.receive", "bytes": frame})
        await asyncio.sleep(0)  # the frame is there, and nobody has seen it
        task.cancel()
        await until_async(task.done)
        assert task.cancelled()

    asyncio.run(run())


def test_a_link_counts_before_it_is_accepted() -> None:
    async def run() -> None:
        nothing: Any = None
        limit = ConcurrencyLimit(1, 1.0)
        endpoint = LinkEndpoint(nothing, limit, limit)
        is_accepting, is_asked = asyncio.Event(), asyncio.Event()
        sent: list[Any] = []

        async def hang(_: Any = None) -> Any:
            is_accepting.set()
            await asyncio.Event().wait()

        def receiver() -> Any:
            messages = iter([{"type": "websocket.connect"}])

            async def receive() -> Any:
                if (message := next(messages, None)) is not None:
                    return message
                is_asked.set()
                return await hang()

            return receive

        async def send(message: Any) -> None:
            sent.append(message)

        first = asyncio.create_task(endpoint(SCOPE, receiver(), hang))
        await is_accepting.wait()
        second = asyncio.create_task(endpoint(SCOPE, receiver(), send))
        greeted = asyncio.create_task(is_asked.wait())
        await asyncio.wait([second, greeted], return_when=asyncio.FIRST_COMPLETED)
        assert [message["type"] for message in sent] == ["websocket.accept", "websocket.close"]
        assert sent[-1]["code"] == 1013
        for task in (first, second, greeted):
            task.cancel()
        await asyncio.gather(first, second, greeted, return_exceptions=True)

    asyncio.run(run())
