"""The sockets for scripts: one connection each, from its hello to its end."""

import asyncio
from collections.abc import Callable
from contextlib import suppress

from starlette.types import Message, Receive, Scope, Send

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.frames import EXTENSION, FramesProtocol
from ai4u_edu.server.rate import Rate
from ai4u_edu.server.scripts.agent_lease import Seat
from ai4u_edu.server.scripts.lease_registry import Seats
from ai4u_edu.server.scripts.outbox import Line
from ai4u_edu.server.scripts.refusal import RefusalError, wrong_version
from ai4u_edu.server.scripts.session import Session
from ai4u_edu.server.scripts.settings import Rules
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import WireError

PER_SECOND = 500
"""Frames from one script that answer nothing: repeated, late, malformed. What answers a percept is
not counted, since percepts come one by one."""
MISTAKES = 5
"""Malformed frames in a row after which a script is not listened to any more."""
HELLO_WITHIN = 10.0
"""Seconds that a connection has to say who it is."""


class RemoteSockets:
    """The sockets for scripts of a room; an ASGI app.

    Args:
        runner: the room's.
        title: tells the room's, which may change.
        rules: of the room.
    """

    def __init__(
        self, runner: Runner, title: Callable[[], str], rules: Rules | None = None
    ) -> None:
        self._seats = Seats(runner, title, rules or Rules())

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One connection, from its beginning to its end."""
        await receive()
        known = native.SUBPROTOCOL in scope["subprotocols"]
        subprotocol = native.SUBPROTOCOL if known else None
        await send({"type": "websocket.accept", "subprotocol": subprotocol})
        frames: FramesProtocol | None = scope.get("extensions", {}).get(EXTENSION)
        line = Line(send, frames.write if frames else None)
        telling = asyncio.create_task(line.run())
        connection = _Connection(receive, line, self._seats)
        if frames:
            frames.listener = connection.hear_answer
        try:
            if known:
                await connection.listen()
            else:
                spoken = ", ".join(scope["subprotocols"]) or "none"
                line.end_by("version", wrong_version(f"subprotocol {native.SUBPROTOCOL!r}", spoken))
            if line.is_ending:
                await asyncio.wait_for(telling, 5)
        finally:
            if connection.seat is not None:
                connection.seat.lose(line)
            telling.cancel()
            with suppress(asyncio.CancelledError, OSError, TimeoutError):
                await telling


class _Connection:
    def __init__(self, receive: Receive, line: Line, seats: Seats) -> None:
        self._receive = receive
        self._line = line
        self._seats = seats
        self._rate = Rate(PER_SECOND)
        self._mistakes = 0
        self._hello: native.Hello | None = None
        self.seat: Seat | None = None

    async def listen(self) -> None:
        """Hears a script, until one side closes."""
        while not self._line.is_ending:
            try:
                message = await (self._receive() if self.seat else self._first())
            except TimeoutError:
                self._line.end_by("malformed", f"expected a hello within {HELLO_WITHIN:g} s")
                return
            if message["type"] != "websocket.receive":
                return
            frame = message.get("bytes") or (message.get("text") or "").encode()
            if len(frame) > native.LARGEST_SAID:
                text = f"expected at most {native.LARGEST_SAID} bytes in a frame, got {len(frame)}"
                self._line.end_by("too_large", text)
                return
            try:
                said = native.decode(frame)
            except WireError as error:
                self._complain("bad_message", str(error))
                continue
            await self._hear(said)

    def hear_answer(self, frame: bytes) -> bool:
        """Hears a frame by the short way, if it is the answer to a percept."""
        if self.seat is None or self._line.is_ending or len(frame) > native.LARGEST_SAID:
            return False
        try:
            said = native.decode(frame)
        except WireError:
            return False
        if not isinstance(said, native.Answer):
            return False
        self._answer(self.seat.session, said)
        return True

    def _answer(self, session: Session, said: native.Answer) -> None:
        before = session.ignored
        problem = session.hear(said)
        if problem is not None:
            self._line.say(native.encode(problem))
        waits = isinstance(said, native.Order) and said.word == "wait"
        if problem is not None or waits or session.ignored > before:
            self._limit()
        self._mistakes = 0

    async def _first(self) -> Message:
        async with asyncio.timeout(HELLO_WITHIN):
            return await self._receive()

    async def _hear(self, said: native.Message) -> None:
        match said:
            case native.Action() | native.Reset() | native.Order() if self.seat is not None:
                self._answer(self.seat.session, said)
            case native.Hello():
                self._limit()
                await self._greet(said)
            case native.Bye(reason) if self.seat is not None:
                self.seat.leave(reason)
            case _:
                kind = type(said).__name__.lower()
                expected = "an action, a reset or a bye" if self.seat else "a hello"
                self._complain("bad_message", f"expected {expected}, got a {kind}")

    async def _greet(self, hello: native.Hello) -> None:
        if self._hello not in (None, hello):
            self._complain("bad_message", "expected one hello in a connection, got another one")
            return
        self._hello = hello
        try:
            self.seat = await self._seats.enter(hello, self._line)
        except RefusalError as refusal:
            self._line.end_by(refusal.code, str(refusal))

    def _complain(self, code: str, text: str) -> None:
        self._mistakes += 1
        if self._mistakes >= MISTAKES:
            self._line.end_by(
                "malformed", f"{MISTAKES} malformed frames in a row; the last: {text}"
            )
            return
        self._line.say(native.encode(native.Problem(code, text, 0)))
        self._limit()

    def _limit(self) -> None:
        if self._rate.take():
            self._line.end_by(
                "too_fast", f"expected at most {PER_SECOND} frames a second that answer nothing"
            )
