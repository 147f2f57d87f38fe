"""The input socket: a page's keys, its wish to drive or not to, and a few commands."""

import asyncio
import json
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from itertools import count
from typing import NamedTuple

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NameNotFoundError
from ai4u_edu.blocks.brains.controllers.keyboard import Stick
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import messages
from ai4u_edu.server import page_events as news
from ai4u_edu.server.bindings import choose
from ai4u_edu.server.control_lock import Seat
from ai4u_edu.server.human_override import Hands
from ai4u_edu.server.rate import Rate

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
MAX_COMPLAINT_CHARS = 2000
"""Characters of what a page is told about a message of its own, which may be repeated in it."""
MAX_AWAITED = 50
"""Of so many things that a page has asked for it is told if they could not be done."""
ANOTHER = "another world"
"""Why a page's socket is closed (1012) when another world has taken this one's place."""
AFTER_ANOTHER = "after_another"
"""With this in its address a page comes back: it takes any agent if its own is not there."""


class Inputs:
    """The input sockets of a room; an ASGI app.

    Args:
        runner: whose agents are driven.
        title: tells what the scene is called now.
    """

    def __init__(self, runner: Runner, title: Callable[[], str] = str) -> None:
        self._runner, self._title = runner, title
        self._places: dict[str, _Place] = {}
        self._numbers = count(1)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One page's socket, from its beginning to its end."""
        socket = WebSocket(scope, receive, send)
        await socket.accept()
        with suppress(WebSocketDisconnect):
            sim, wanted = self._runner.sim, socket.query_params.get("agent")
            try:
                agent = choose(sim, wanted)
            except NameNotFoundError as error:
                if AFTER_ANOTHER not in socket.query_params:
                    await socket.send_json(news.error(str(error)))
                    await socket.close(1008, "there is no such agent")
                    return
                agent = choose(sim, None)
            place, number = self._place(agent), next(self._numbers)
            await _Page(socket, self._runner, sim, place, number, self._title).talk()

    def _place(self, agent: BasicAgent) -> "_Place":
        """An agent's place; in another world the agent of the same id has another one."""
        place = self._places.get(agent.id)
        if place is None or place.agent is not agent:
            hands = Hands(self._runner, agent)
            place = self._places[agent.id] = _Place(agent, Seat(agent.keyboard, hands), hands)
        return place


class _Place(NamedTuple):
    agent: BasicAgent
    seat: Seat
    hands: Hands


class _Page:
    """One page at its agent's place."""

    def __init__(
        self,
        socket: WebSocket,
        runner: Runner,
        sim: ControlRequestor,
        place: _Place,
        number: int,
        title: Callable[[], str],
    ) -> None:
        self._title = title
        self._socket = socket
        self._runner = runner
        self._sim = sim
        self._agent, self._seat, self._hands = place
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
                await self._end(1008, f"expected at most {PER_SECOND} messages a second")
                return
            said = frame.get("text") or frame.get("bytes") or ""
            if len(said) > LARGEST:
                await self._complain(f"expected at most {LARGEST} bytes, got {len(said)}")
                await self._end(1009, f"expected at most {LARGEST} bytes in a message")
                return
            try:
                message = messages.read(said)
            except ValueError as error:
                mistakes += 1
                await self._complain(str(error))
                if mistakes >= MISTAKES:
                    await self._end(1008, f"{MISTAKES} malformed messages in a row")
                    return
                continue
            mistakes = 0
            if self._runner.sim is not self._sim:
                continue  # it is about to be told
            self._obey(message)

    def _obey(self, message: messages.Message) -> None:
        match message:
            case messages.Keys(held=held, stick=stick):
                pushed = Stick(stick.forward, stick.turn)
                self._await(self._seat.hold(self._number, held, pushed))
            case messages.Take():
                self._await(self._seat.take(self._number))
            case messages.LetGo():
                self._await(self._seat.let_go(self._number))
            case messages.Order(name="reset", seed=seed):
                self._order(lambda: self._runner.reset(seed))
            case messages.Order(name="pause"):
                self._order(self._runner.pause)
            case messages.Order(name="resume"):
                self._order(self._runner.resume)

    def _order(self, order: Callable[[], "Future[None]"]) -> None:
        if len(self._orders) < ORDERS:
            self._await(order())

    def _await(self, future: "Future[None] | None") -> None:
        if future is not None and len(self._orders) < MAX_AWAITED:
            task = asyncio.create_task(self._carry_out(future))
            self._orders.add(task)
            task.add_done_callback(self._orders.discard)

    async def _carry_out(self, future: "Future[None]") -> None:
        # keys that come meanwhile must not wait for the runner
        with suppress(WebSocketDisconnect):
            try:
                # shielded: what was asked for is done, also if the page leaves meanwhile
                await asyncio.shield(asyncio.wrap_future(future))
            except Exception as error:  # a student's block may raise anything in a reset
                await self._complain(f"{type(error).__name__}: {error}")

    async def _complain(self, text: str) -> None:
        await self._say(json.dumps(news.error(text[:MAX_COMPLAINT_CHARS])))

    async def _end(self, code: int, reason: str) -> None:
        # while too much is said, the world may become another one: either task ends it, not both
        if self._socket.application_state is WebSocketState.CONNECTED:
            await self._socket.close(code, reason)

    async def _say(self, text: str) -> None:
        # whoever tells the news may wake up when the connection has just been closed from here
        if self._socket.application_state is WebSocketState.CONNECTED:
            await self._socket.send_text(text)

    async def _tell(self, changed: asyncio.Event) -> None:
        told: dict[str, str] = {}
        while self._runner.sim is self._sim:
            changed.clear()
            for frame in (
                news.hello(self._agent, self._number, self._hands),
                news.seating(self._seat),
                news.state(self._runner.latest, self._agent.id, self._title()),
            ):
                if frame is None:
                    continue
                text = json.dumps(frame)
                if told.get(frame["type"]) != text:
                    told[frame["type"]] = text
                    await self._say(text)
            # before Python 3.12 a wait_for whose event has just come forgets that it was cancelled
            with suppress(TimeoutError):
                async with asyncio.timeout(LOOK):
                    await changed.wait()
        await self._end(1012, ANOTHER)
