"""The input socket: a page sends its keys, requests control, and a few commands."""

import asyncio
import json
import math
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from itertools import count
from typing import NamedTuple

import msgspec
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import RESTART, keys_of
from ai4u_edu.base.errors import NameNotFoundError, shorten, text_of
from ai4u_edu.blocks.keyboard import CENTERED, Stick
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.messages import Message, PageCommand, translated
from ai4u_edu.page.server.bindings import choose_agent
from ai4u_edu.page.server.class_feed import ClassFeed, PageOfClass
from ai4u_edu.page.server.control_lock import ControlLock
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.page.server.input_messages import (
    INPUT_READER,
    ErrorEvent,
    InputEvent,
    Keys,
    Release,
    Start,
    Take,
    hello_event,
    seat_event,
    state_event,
)
from ai4u_edu.page.server.limits.keepalive import keepalives
from ai4u_edu.page.server.loop_queue import result_of
from ai4u_edu.page.server.page_receiver import ReceiveLimits, close_socket, receive_messages
from ai4u_edu.page.server.run_commands import RUN_COMMANDS
from ai4u_edu.runtime.runner import Runner

MAX_MESSAGE_BYTES = 4096
MAX_MESSAGES_PER_S = 200
"""Rate limit of one page; it sends ten a second, and one for each change of the keys."""
POLL_S = 0.2
"""Period at which the state is compared with what the page knows."""
HELLO_S = 1.0
"""The same for the keys, which change if the scene is edited; a new driver is sent at once."""
MAX_PENDING_COMMANDS = 4
"""Commands of one page that may wait for the runner."""
MAX_ERROR_CHARS = 2000
"""Length of an error that is sent to a page; it may repeat the page's own message."""
MAX_AWAITED = 50
"""Requests of one page whose errors are reported at a time; errors of further ones are not."""
WORLD_REPLACED = "another world"
"""Reason of the close (1012) when another world has replaced this one; the page reconnects."""
RECONNECT_PARAM = "after_another"
"""Query parameter of a page that reconnects: it takes any agent if its own does not exist."""


class Inputs:
    """The input sockets of a world; an ASGI app.

    Args:
        runner: runs the world whose agents are driven.
        title: returns the scene's present title.
        class_feed: of the class that the room belongs to, if it does.
    """

    def __init__(
        self,
        runner: Runner,
        title: Callable[[], str] = str,
        class_feed: ClassFeed | None = None,
    ) -> None:
        self._runner, self._title, self._class_feed = runner, title, class_feed
        self._controls: dict[str, _Controls] = {}
        self._numbers = count(1)
        self._seats: dict[int, int] = {}
        """Numbers of the seats of a class by the numbers of their open pages."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one page's socket until it is closed."""
        socket = WebSocket(scope, receive, send)
        await socket.accept()
        with suppress(WebSocketDisconnect):
            sim, wanted = self._runner.sim, socket.query_params.get("agent")
            try:
                agent = choose_agent(sim, wanted)
            except NameNotFoundError as error:
                if RECONNECT_PARAM not in socket.query_params:
                    await socket.send_text(_json(ErrorEvent(text_of(error))))
                    await socket.close(1008, _("there is no such agent"))
                    return
                agent = choose_agent(sim, None)
            controls, number = self._controls_of(agent), next(self._numbers)
            page = _Page(socket, self._runner, sim, controls, number, self._title, self._seats)
            class_page = PageOfClass(self._class_feed, socket.headers)
            self._seats[number] = class_page.seat
            try:
                await page.serve(class_page)
            finally:
                del self._seats[number]

    def _controls_of(self, agent: BasicAgent) -> "_Controls":
        """Return an agent's lock and override; those of an agent in an earlier world are replaced.

        Agents of two worlds may have the same id.
        """
        controls = self._controls.get(agent.id)
        if controls is None or controls.agent is not agent:
            override = HumanOverride(self._runner, agent)
            lock = ControlLock(agent.keyboard, override)
            controls = self._controls[agent.id] = _Controls(agent, lock, override)
        return controls


class _Controls(NamedTuple):
    agent: BasicAgent
    lock: ControlLock
    override: HumanOverride


class _Page:
    """One page's connection."""

    def __init__(
        self,
        socket: WebSocket,
        runner: Runner,
        sim: ControlRequestor,
        controls: _Controls,
        number: int,
        title: Callable[[], str],
        seats: Mapping[int, int],
    ) -> None:
        self._title, self._seats = title, seats
        self._socket = socket
        self._runner = runner
        self._sim = sim
        self._agent, self._lock, self._override = controls
        self._number = number
        self._requests: set[asyncio.Task[None]] = set()
        self._held: frozenset[str] = frozenset()
        self._stick = CENTERED

    async def serve(self, class_page: PageOfClass) -> None:
        changed = self._lock.add_page(self._number)
        sending = asyncio.create_task(self._send_events(changed, class_page))
        try:
            async with keepalives(self._send):
                await self._receive()
        finally:
            self._lock.remove_page(self._number)
            for task in (sending, *self._requests):
                task.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect):
                await sending

    async def _receive(self) -> None:
        limits = ReceiveLimits(MAX_MESSAGES_PER_S, MAX_MESSAGE_BYTES)
        async for message in receive_messages(
            self._socket, limits, INPUT_READER.read, self._refuse
        ):
            if self._runner.sim is self._sim:  # else the other task closes the connection soon
                self._handle(message)

    def _handle(self, message: Message | PageCommand) -> None:
        match message:
            case Keys(held=held, stick=stick):
                self._hold(frozenset(held), Stick(stick.forward, stick.turn))
            case Start():
                self._start()
            case Take():
                self._await(self._lock.acquire(self._number))
            case Release():
                self._await(self._lock.release(self._number))
            case PageCommand():
                command = RUN_COMMANDS[type(message)]
                self._command(lambda: command.submit(self._runner, message))

    def _hold(self, held: frozenset[str], stick: Stick) -> None:
        """Drive with what is held; what has been pressed again may start or repeat an episode.

        A key that is still held when an episode begins does not start it: pages repeat what is
        held, and the person has not seen the new start.
        """
        pressed, is_pushed = held - self._held, any(stick) and not any(self._stick)
        self._held, self._stick = held, stick
        if self._runner.is_held:
            return
        restart = self._restart_keys() if held else frozenset[str]()
        # not for the controller: it would draw a new start, it is not asked while the world waits
        # or has an error, and it may be a network
        if pressed & restart and self._lock.driver in (None, self._number):
            self._command(self._runner.try_again)
        self._await(self._lock.hold_keys(self._number, held - restart, stick))
        if (pressed - restart or is_pushed) and self._lock.driver == self._number:
            self._start_episode()

    def _start(self) -> None:
        is_free = self._lock.driver is None and not self._override.current_driver
        if is_free:
            self._await(self._lock.acquire(self._number))
        if self._lock.driver == self._number:
            self._start_episode()

    def _start_episode(self) -> None:
        if self._runner.is_waiting_for_key:
            self._command(self._runner.start_episode)

    def _restart_keys(self) -> frozenset[str]:
        return frozenset(keys_of(self._agent, self._override.brain).get(RESTART, ()))

    def _command(self, command: Callable[[], "Future[None]"]) -> None:
        if len(self._requests) < MAX_PENDING_COMMANDS:
            self._await(command())

    def _await(self, future: "Future[None] | None") -> None:
        """Report an error of a future to the page; keys that come meanwhile must not wait."""
        if future is not None and len(self._requests) < MAX_AWAITED:
            task = asyncio.create_task(self._report(future))
            self._requests.add(task)
            task.add_done_callback(self._requests.discard)

    async def _report(self, future: "Future[None]") -> None:
        with suppress(WebSocketDisconnect):
            try:
                await result_of(future)
            except Exception as error:  # a student's block may raise anything in a reset
                text = _("{error}: {problem}", error=type(error).__name__, problem=text_of(error))
                await self._send_error(text)

    async def _refuse(self, _data: str | bytes, text: str) -> None:
        await self._send_error(text)

    async def _send_error(self, text: str) -> None:
        await self._send(_json(ErrorEvent(shorten(text, MAX_ERROR_CHARS))))

    async def _send(self, text: str) -> None:
        # the task that sends events may wake up just after the other one has closed the socket
        if self._socket.application_state is WebSocketState.CONNECTED:
            await self._socket.send_text(text)

    async def _send_events(self, changed: asyncio.Event, class_page: PageOfClass) -> None:
        sent: dict[type[InputEvent], InputEvent] = {}
        hello_at, known = -math.inf, None
        while self._runner.sim is self._sim:
            driver = self._override.brain, self._override.current_driver
            now, is_changed = time.monotonic(), changed.is_set() or driver != known
            changed.clear()
            if (news := class_page.news()) is not None:
                await self._send(_json(news))
            events: list[InputEvent] = [seat_event(self._lock, self._seats)]
            if is_changed or now >= hello_at:
                hello_at, known = now + HELLO_S, driver
                events.insert(0, hello_event(self._agent, self._number, self._override))
            state = state_event(self._runner.latest, self._agent.id, self._title())
            if state is not None:
                events.append(state)
            for event in events:
                if sent.get(type(event)) != event:
                    sent[type(event)] = event
                    await self._send(_json(event))
            # before Python 3.12 a wait_for whose event has just come forgets that it was cancelled
            with suppress(TimeoutError):
                async with asyncio.timeout(POLL_S):
                    await changed.wait()
        await close_socket(self._socket, 1012, WORLD_REPLACED)


def _json(message: object) -> str:
    # msgspec's own encoder refuses half of a surrogate pair, which a student's error may have
    return json.dumps(msgspec.to_builtins(message, enc_hook=translated))
