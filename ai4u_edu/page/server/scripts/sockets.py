"""The WebSocket endpoint for scripts: one connection each, from its hello to its end."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from urllib.parse import parse_qs

from starlette.requests import HTTPConnection
from starlette.types import Message, Receive, Scope, Send

from ai4u_edu.base.errors import text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.frames import EXTENSION, FramesProtocol
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.scripts.agent_lease import (
    AgentLease,
    LeaseRegistry,
    RefusalError,
    wrong_version,
)
from ai4u_edu.page.server.scripts.outbox import Outbox
from ai4u_edu.page.server.scripts.report import NoReport, ScriptLog
from ai4u_edu.page.server.scripts.session import Session, is_request_for_time
from ai4u_edu.page.server.scripts.settings import Rules
from ai4u_edu.page.server.token_auth import PageCookie, is_same_secret
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native
from ai4u_edu.wire.json_form import JsonForm
from ai4u_edu.wire.validation import WireError, shown

MAX_STRAY_FRAMES_PER_S = 500
"""Rate limit of a script's frames that answer nothing: repeated, late, malformed. An answer to a
percept does not count, since the world sends percepts one by one."""
MAX_MALFORMED_FRAMES = 5
"""Malformed frames in a row after which the connection is closed."""
CLOSE_TIMEOUT_S = 5.0
"""Time that the last frames and the close may take to be sent."""
FORMATS = ("msgpack", "json")
"""Forms of messages, by ``?format=`` in the address; see :mod:`ai4u_edu.wire.json_form`."""


class RemoteSockets:
    """The WebSocket endpoint for a room's scripts; an ASGI app.

    Args:
        runner: the room's.
        title: returns the room's title, which may change.
        rules: of the room.
        report: of what happens with scripts, for whoever runs the world.
    """

    def __init__(
        self,
        runner: Runner,
        title: Callable[[], str],
        rules: Rules | None = None,
        report: ScriptLog | None = None,
    ) -> None:
        self._rules = rules = rules or Rules()
        self._report = NoReport() if report is None else report
        self._leases = LeaseRegistry(runner, title, rules, self._report)
        self._credentials = f"Bearer {rules.token}" if rules.token else ""
        self._cookie = PageCookie(rules.token)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection, from its handshake to its close."""
        await receive()
        is_known = native.SUBPROTOCOL in scope["subprotocols"]
        subprotocol = native.SUBPROTOCOL if is_known else None
        await send({"type": "websocket.accept", "subprotocol": subprotocol})
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("format", FORMATS)[0]
        form = JsonForm() if given == "json" else None
        # a frame that is text takes the usual way through ASGI
        frames: FramesProtocol | None = None
        if form is None:
            frames = scope.get("extensions", {}).get(EXTENSION)
        outbox = Outbox(send, frames.write if frames else None, form)
        sending = asyncio.create_task(outbox.run())
        connection = _ScriptConnection(
            receive,
            outbox,
            self._leases,
            self._report,
            form=form,
            hello_timeout=self._rules.hello_timeout,
            is_authenticated=self._is_authenticated(HTTPConnection(scope)),
        )
        if frames:
            frames.listener = connection.hear_answer
        try:
            if given not in FORMATS:
                text: str = _("format: expected msgpack or json, got {name}", name=shown(given))
                outbox.close_with_problem("malformed", text)
            elif is_known:
                await connection.listen()
            else:
                spoken: str = ", ".join(scope["subprotocols"]) or _("none")
                text = wrong_version(_("subprotocol {name!r}", name=native.SUBPROTOCOL), spoken)
                outbox.close_with_problem("version", text)
            if outbox.is_closing:
                # not wait_for, which in Python 3.11 loses a cancellation that comes with the end
                with suppress(TimeoutError):  # it reads nothing, and hears no close either
                    async with asyncio.timeout(CLOSE_TIMEOUT_S):
                        await sending
        finally:
            if connection.lease is not None:
                connection.lease.detach(outbox)
            sending.cancel()
            with suppress(asyncio.CancelledError, OSError, TimeoutError):
                await sending

    def _is_authenticated(self, given: HTTPConnection) -> bool:
        """Return True for a class's gateway, which has asked for the script's key, or a page."""
        sent = given.headers.get("authorization", "")
        return bool(self._credentials) and (
            is_same_secret(self._credentials, sent) or self._cookie.is_in(given)
        )


class _ScriptConnection:
    """One script's frames, and its lease once it has one."""

    def __init__(
        self,
        receive: Receive,
        outbox: Outbox,
        leases: LeaseRegistry,
        report: ScriptLog,
        *,
        form: JsonForm | None,
        hello_timeout: float,
        is_authenticated: bool,
    ) -> None:
        self._hello_timeout = hello_timeout
        self._is_authenticated = is_authenticated
        self._receive = receive
        self._outbox = outbox
        self._leases = leases
        self._report = report
        self._form = form
        self._rate = RateLimit(MAX_STRAY_FRAMES_PER_S)
        self._malformed = 0
        self._hello: native.Hello | None = None
        self.lease: AgentLease | None = None

    async def listen(self) -> None:
        """Handle a script's frames, until one side closes."""
        while not self._outbox.is_closing:
            try:
                message = await (self._receive() if self.lease else self._receive_hello())
            except TimeoutError:
                seconds = f"{self._hello_timeout:g}"
                text = _("expected a hello within {seconds} s", seconds=seconds)
                self._outbox.close_with_problem("malformed", text)
                return
            if message["type"] != "websocket.receive":
                return
            frame = message.get("bytes") or (message.get("text") or "").encode()
            if len(frame) > native.MAX_SCRIPT_FRAME_BYTES:
                most = native.MAX_SCRIPT_FRAME_BYTES
                text = _(
                    "expected at most {most} bytes in a frame, got {got}", most=most, got=len(frame)
                )
                self._outbox.close_with_problem("too_large", text)
                return
            try:
                heard = native.decode(self._form.frame_of(frame) if self._form else frame)
            except WireError as error:
                self._complain("bad_message", text_of(error))
                continue
            await self._handle(heard)

    def hear_answer(self, frame: bytes) -> bool:
        """Handle a frame without the detour through ASGI; return False if it is no answer."""
        if self.lease is None or self._outbox.is_closing:
            return False
        try:
            heard = native.decode(frame)
        except WireError:
            return False
        if not isinstance(heard, native.Answer):
            return False
        self._handle_answer(self.lease.session, heard)
        return True

    def _handle_answer(self, session: Session, answer: native.Answer) -> None:
        before = session.ignored
        problem = session.hear(answer)
        if problem is not None:
            self._outbox.send_problem(problem)
        if problem is not None or is_request_for_time(answer) or session.ignored > before:
            self._limit_rate()
        self._malformed = 0

    async def _receive_hello(self) -> Message:
        async with asyncio.timeout(self._hello_timeout):
            return await self._receive()

    async def _handle(self, message: native.Message) -> None:
        match message:
            case native.Action() | native.Reset() | native.Order() if self.lease is not None:
                self._handle_answer(self.lease.session, message)
            case native.Hello():
                self._limit_rate()
                await self._acquire_lease(message)
            case native.Bye(reason) if self.lease is not None:
                self.lease.release(reason)
            case _:
                kind = type(message).__name__.lower()
                text = _("expected a hello, got a {message}", message=kind)
                if self.lease:
                    text = _(
                        "expected an action, a reset or a bye, got a {message}",
                        message=kind,
                    )
                self._complain("bad_message", text)

    async def _acquire_lease(self, hello: native.Hello) -> None:
        if self._hello not in (None, hello):
            text = _("expected one hello in a connection, got another one")
            self._complain("bad_message", text)
            return
        self._hello = hello
        try:
            self.lease = await self._leases.acquire(
                hello, self._outbox, is_authenticated=self._is_authenticated
            )
        except RefusalError as refusal:
            if refusal.code != "session_over":  # a client begins another session by itself
                text = _("a script was refused: {problem}", problem=text_of(refusal))
                self._report.note_mistake(refusal.code, text)
            self._outbox.close_with_problem(refusal.code, text_of(refusal))

    def _complain(self, code: str, text: str) -> None:
        """Send a problem; close the connection after too many in a row."""
        line = _("a script sent what has no effect: {problem}", problem=text)
        self._report.note_mistake(code, line)
        self._malformed += 1
        if self._malformed >= MAX_MALFORMED_FRAMES:
            text = _(
                "{n} malformed frames in a row; the last: {problem}",
                n=MAX_MALFORMED_FRAMES,
                problem=text,
            )
            self._outbox.close_with_problem("malformed", text)
            return
        self._outbox.send_problem(native.Problem(code, text, 0))
        self._limit_rate()

    def _limit_rate(self) -> None:
        if self._rate.take():
            text = _(
                "expected at most {n} frames a second that answer nothing", n=MAX_STRAY_FRAMES_PER_S
            )
            self._outbox.close_with_problem("too_fast", text)
