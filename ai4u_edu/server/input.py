"""The input socket: a page's keys, its wish to drive, and a few commands."""

import asyncio
import json
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from itertools import count

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.agent import BasicAgent
from ai4u_edu.errors import NameNotFoundError
from ai4u_edu.runner import Runner
from ai4u_edu.server import messages, news
from ai4u_edu.server.bindings import choose
from ai4u_edu.server.frames import CAP, EXTENSION, FramesProtocol
from ai4u_edu.server.rate import Rate
from ai4u_edu.server.seat import Seat

LARGEST = 4096
"""Bytes of a message."""
PER_SECOND = 200
"""Messages from one page; it sends ten and what the fingers add."""
MISTAKES = 5
"""Malformed messages in a row after which a page is not listened to any more."""
LOOK = 0.2
"""How often it is looked (s) whether a page has to be told something."""
ORDERS = 4
"""Commands of one page that may wait for the runner."""


class Inputs:
    """The input sockets of a room; an ASGI app."""

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self._seats: dict[str, Seat] = {}
        self._numbers = count(1)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One page's socket, from its beginning to its end."""
        socket = WebSocket(scope, receive, send)
        await socket.accept()
        frames: FramesProtocol | None = scope.get("extensions", {}).get(EXTENSION)
        if frames:
            frames.cap(CAP)
        with suppress(WebSocketDisconnect):
            try:
                agent = choose(self._runner.sim, socket.query_params.get("agent"))
            except NameNotFoundError as error:
                await socket.send_json(news.error(str(error)))
                await socket.close(1008, "there is no such agent")
                return
            seat = self._seats.setdefault(agent.id, Seat(agent.keyboard))
            await _Page(socket, self._runner, agent, seat, next(self._numbers)).talk()


class _Page:
    """One page at its agent's seat."""

    def __init__(
        self, socket: WebSocket, runner: Runner, agent: BasicAgent, seat: Seat, number: int
    ) -> None:
        self._socket = socket
        self._runner = runner
        self._agent = agent
        self._seat = seat
        self._number = number
        self._orders: set[asyncio.Task[None]] = set()

    async def talk(self) -> None:
        changed = self._seat.enter(self._number)
        telling = asyncio.create_task(self._tell(changed))
        try:
            await self._listen()
        finally:
            self._seat.leave(self._number)
            for task in (telling, *self._orders):
                task.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect):
                await telling

    async def _listen(self) -> None:
        rate, mistakes = Rate(PER_SECOND), 0
        while True:
            frame = await self._socket.receive()
            if frame["type"] != "websocket.receive":
                return
            if rate.take():
                await self._socket.close(1008, f"expected at most {PER_SECOND} messages a second")
                return
            said = frame.get("text") or frame.get("bytes") or ""
            if len(said) > LARGEST:
                await self._complain(f"expected at most {LARGEST} bytes, got {len(said)}")
                await self._socket.close(1009, f"expected at most {LARGEST} bytes in a message")
                return
            try:
                message = messages.read(said)
            except ValueError as error:
                mistakes += 1
                await self._complain(str(error))
                if mistakes >= MISTAKES:
                    await self._socket.close(1008, f"{MISTAKES} malformed messages in a row")
                    return
                continue
            mistakes = 0
            self._obey(message)

    def _obey(self, message: messages.Message) -> None:
        match message:
            case messages.Keys(held=held):
                self._seat.hold(self._number, held)
            case messages.Take():
                self._seat.take(self._number)
            case messages.Order(name="reset", seed=seed):
                self._order(lambda: self._runner.reset(seed))
            case messages.Order(name="pause"):
                self._order(self._runner.pause)
            case messages.Order(name="resume"):
                self._order(self._runner.resume)

    def _order(self, order: Callable[[], "Future[None]"]) -> None:
        if len(self._orders) < ORDERS:
            task = asyncio.create_task(self._carry_out(order()))
            self._orders.add(task)
            task.add_done_callback(self._orders.discard)

    async def _carry_out(self, future: "Future[None]") -> None:
        # keys that come meanwhile must not wait for the runner
        with suppress(WebSocketDisconnect):
            try:
                await asyncio.wrap_future(future)
            except Exception as error:  # a student's block may raise anything in a reset
                await self._complain(f"{type(error).__name__}: {error}")

    async def _complain(self, text: str) -> None:
        await self._say(json.dumps(news.error(text)))

    async def _say(self, text: str) -> None:
        # whoever tells the news may wake up when the connection has just been closed from here
        if self._socket.application_state is WebSocketState.CONNECTED:
            await self._socket.send_text(text)

    async def _tell(self, changed: asyncio.Event) -> None:
        told: dict[str, str] = {}
        while True:
            changed.clear()
            for frame in (
                news.hello(self._agent, self._number),
                news.seating(self._seat),
                news.state(self._runner.latest, self._agent.id),
            ):
                text = json.dumps(frame)
                if told.get(frame["type"]) != text:
                    told[frame["type"]] = text
                    await self._say(text)
            # before Python 3.12 a wait_for whose event has just come forgets that it was cancelled
            with suppress(TimeoutError):
                async with asyncio.timeout(LOOK):
                    await changed.wait()
