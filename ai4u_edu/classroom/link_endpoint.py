"""WebSocket of the class for links of rooms and notebooks; see :mod:`ai4u_edu.wire.class_link`."""

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.classroom.course_index import known_exercises
from ai4u_edu.classroom.errors import NetworkError, StoreError
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import LiveRoom
from ai4u_edu.classroom.result_writer import Received
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.attempts import AttemptResult, Attempts, client_address
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit, TooManyOpenError
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.limits.socket_close import (
    NOT_ALLOWED,
    TRY_LATER,
    close_reason,
    refuse_socket,
)
from ai4u_edu.wire.class_link import (
    SUBPROTOCOL,
    VERSION,
    Ack,
    Applied,
    Drawing,
    EpisodeResult,
    ExerciseResult,
    FromClass,
    FromRoom,
    HandedInNetwork,
    Learn,
    LinkHello,
    LinkProblem,
    Poses,
    Practise,
    Result,
    State,
    StopTraining,
    Task,
    Work,
    decode_from_room,
    encode_from_class,
)
from ai4u_edu.wire.validation import WireError

HELLO_TIMEOUT_S = 5.0
MESSAGES_PER_S = 50.0
"""Rate limit for messages of one link; more are taken later, and none is lost."""
BYTES_PER_S = 2 * 2**20
"""Rate at which large messages of one link are taken."""
LARGE_BYTES = 2**14
MAX_STATE_BYTES = 2**18
"""Size of a drawing, poses or a state: what is shown on the wall."""
MAX_MISTAKES = 5
"""Malformed messages in a row after which a link is ended."""
MAX_WAITING_ACKS = 1000
FindRoom = Callable[[str, str], Awaitable[LiveRoom | None]]


class LinkEndpoint:
    """ASGI app that serves links.

    Args:
        live: the class.
        strangers: limit of links before their hello, by address.
        seated: limit of the sockets of seats.
        find_room: returns the room of a link by its secret and address, or None; default: by the
            secrets of rooms and the tokens of seats. Any :class:`AI4UError` closes the link, which
            is opened again later.
    """

    def __init__(
        self,
        live: LiveClass,
        strangers: ConcurrencyLimit,
        seated: ConcurrencyLimit,
        find_room: FindRoom | None = None,
    ) -> None:
        self._live, self._find_room = live, find_room
        self._strangers, self._seated = strangers, seated
        self._attempts = Attempts()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one link until one side ends it."""
        socket = WebSocket(scope, receive, send)
        subprotocol = SUBPROTOCOL if SUBPROTOCOL in scope["subprotocols"] else None
        with suppress(WebSocketDisconnect):
            try:
                # counted before it is accepted: the next one comes as soon as this one is open
                async with self._strangers.one_of(client_address(scope)):
                    await socket.accept(subprotocol)
                    room = await self._greet(socket)
                if room is not None and room.seat:
                    async with self._seated.one_of(room.seat):
                        await self._serve(socket, room)
                elif room is not None:
                    await self._serve(socket, room)
            except TooManyOpenError as error:
                if socket.application_state is WebSocketState.CONNECTING:
                    await refuse_socket(scope, receive, send, TRY_LATER, text_of(error))
                elif socket.application_state is WebSocketState.CONNECTED:
                    await socket.close(TRY_LATER, close_reason(text_of(error)))

    async def _serve(self, socket: WebSocket, room: LiveRoom) -> None:
        """Serve the link of a room."""
        self._live.ensure_ticking()
        link = LinkSender(socket)
        sender = asyncio.create_task(link.run())
        self._live.connect(room, link)
        try:
            if room.seat:  # now that whoever ends links knows this one
                await asyncio.to_thread(self._live.seats.note_opened, room.seat)
            await self._receive(socket, room, link)
        finally:
            self._live.disconnect(room, link)
            link.stop()
            with suppress(asyncio.CancelledError, WebSocketDisconnect):
                await sender

    async def _greet(self, socket: WebSocket) -> LiveRoom | None:
        """Return the room that a link's hello names; end the link if it names none."""
        try:
            # not wait_for, which in Python 3.11 loses a cancellation that comes with the frame
            async with asyncio.timeout(HELLO_TIMEOUT_S):
                frame = await _frame(socket)
            hello = decode_from_room(frame)
        except TimeoutError:
            await _refuse(
                socket,
                LinkProblem(
                    "message",
                    _(
                        "expected hello within {limit:g} s",
                        limit=HELLO_TIMEOUT_S,
                    ),
                ),
            )
            return None
        except WireError as error:
            await _refuse(socket, LinkProblem("message", text_of(error)))
            return None
        if not isinstance(hello, LinkHello):
            await _refuse(socket, LinkProblem("message", _("expected hello as the first message")))
            return None
        if hello.version != VERSION:
            text = _(
                "expected version {version} of the class's protocol, got {got}; install the "
                "version of ai4u-edu that your teacher has",
                version=VERSION,
                got=hello.version,
            )
            await _refuse(socket, LinkProblem("version", text))
            return None
        found: list[LiveRoom] = []
        address = client_address(socket.scope)
        try:
            elsewhere = await self._find_room(hello.secret, address) if self._find_room else None
        except AI4UError as error:
            await socket.close(TRY_LATER, close_reason(text_of(error)))
            return None

        def is_right() -> bool:
            room = elsewhere if self._find_room else self._live.room_of(hello.secret)
            found.extend([room] if room is not None else [])
            return bool(found)

        verdict = await self._attempts.check(address, is_right)
        if verdict is AttemptResult.TOO_MANY:
            await socket.close(
                TRY_LATER, close_reason(_("too many wrong secrets from this address"))
            )
            return None
        if not found:
            text = _("This place in the class is not yours any more. Join again.")
            await _refuse(socket, LinkProblem("secret", text))
            return None
        return found[0]

    async def _receive(self, socket: WebSocket, room: LiveRoom, link: "LinkSender") -> None:
        limit, mistakes = RateLimit(MESSAGES_PER_S), 0
        while True:
            if wait_s := limit.take():
                await asyncio.sleep(wait_s)
            try:
                frame = await _frame(socket)
                if len(frame) > LARGE_BYTES:
                    await asyncio.sleep(len(frame) / BYTES_PER_S)
                message = _decoded(frame)
            except WireError as error:
                mistakes += 1
                if mistakes >= MAX_MISTAKES:
                    link.end(
                        _("{most} malformed messages in a row", most=MAX_MISTAKES), code="message"
                    )
                    mistakes = 0
                else:
                    link.add(LinkProblem("message", text_of(error)))
                continue
            mistakes = 0
            if room.link is link:  # what a link sends after its end does not count
                await self._take(room, link, message)

    async def _take(self, room: LiveRoom, link: "LinkSender", message: FromRoom) -> None:
        match message:
            case EpisodeResult() | ExerciseResult():
                self._take_result(room, link, message)
                return
            case HandedInNetwork():
                await self._take_network(room, link, message)
                return
            case Learn() | Practise() | Task() | StopTraining():
                await self._take_training(room, link, message)
                return
            case Drawing():
                room.note_drawing(message)
                return
            case Poses():
                room.note_poses(message)
                return
            case State():
                room.note_state(message)
            case Work():
                room.work = message
                await asyncio.to_thread(self._live.keep_work, room, message)
            case Applied():
                room.problem = message.problem
        self._live.note_change()

    async def _take_network(
        self, room: LiveRoom, link: "LinkSender", network: HandedInNetwork
    ) -> None:
        """Keep a network, and acknowledge it when it is on disk."""
        problem = ""
        if not room.seat:
            problem = _("network: expected a link of one seat; use the page")
        elif self._live.store.quota.is_full:
            problem = _("The class's folder is full. Tell your teacher.")
        if problem:
            link.add(LinkProblem("message", problem))
            link.add(Ack(network.key))  # sent again it would be refused again
            return
        given = (network.scene, network.part, network.file, network.data, network.key)
        try:
            await asyncio.to_thread(self._live.tournament.networks.add, room.seat, *given)
        except NetworkError as error:
            link.add(LinkProblem("message", text_of(error)))  # as above
        except StoreError:
            link.close_later()
            return
        link.add(Ack(network.key))

    async def _take_training(
        self, room: LiveRoom, link: "LinkSender", message: Learn | Practise | Task | StopTraining
    ) -> None:
        """Take what a room asks for, and acknowledge it when it is on disk."""
        if room.seat:
            text = _(
                "{tag}: expected a room on the class's machine",
                tag=str(message.__struct_config__.tag),
            )
            link.add(LinkProblem("message", text))
            link.add(Ack(message.key))  # sent again it would be refused again
            return
        live = self._live
        try:
            match message:
                case Learn():
                    await live.trainings.add(room.id, message)
                case Practise():
                    await live.practices.add(room.id, message)
                case Task():
                    await live.tasks.add(room.id, message)
                case StopTraining(training=key):
                    await live.trainings.stop(room.id, key)
                    await live.practices.stop(room.id, key)
                    await live.tasks.stop(room.id, key)
        except StoreError:
            link.close_later()
            return
        link.add(Ack(message.key))

    def _take_result(self, room: LiveRoom, link: "LinkSender", result: Result) -> None:
        if isinstance(result, ExerciseResult) and result.exercise not in known_exercises():
            text = _(
                "exercise: no exercise is called {name!r}; install the version of ai4u-edu that "
                "the class has",
                name=result.exercise[:40],
            )
            link.add(LinkProblem("message", text))
            link.add(Ack(result.key))  # sent again it would be refused again
            return

        def done(is_stored: bool) -> None:
            if is_stored:
                link.add(Ack(result.key))
            else:
                link.close_later()

        seats = tuple(each.number for each in self._live.seats_of(room))
        self._live.results.add(Received(room.id, seats, result, done))


class LinkSender:
    """Sending side of a link: a state that was not sent yet is replaced by the next one.

    Belongs to the event loop; :meth:`run` is its task.

    Args:
        socket: of the link, accepted.
    """

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._states: dict[type, FromClass] = {}
        self._replies: list[FromClass] = []
        self._closing: tuple[int, str] | None = None
        self._wake = asyncio.Event()
        self._task: asyncio.Task[None] | None = None

    def send(self, message: FromClass) -> None:
        """Send a state."""
        self._states.pop(type(message), None)
        self._states[type(message)] = message
        self._wake.set()

    def add(self, message: Ack | LinkProblem) -> None:
        """Send an answer to a message."""
        self._replies.append(message)
        if len(self._replies) > MAX_WAITING_ACKS:  # it does not read
            self._closing = (NOT_ALLOWED, _("expected acknowledgements to be read"))
        self._wake.set()

    def end(self, sentence: str, code: str = "over") -> None:
        """End the link for good."""
        self._states.clear()
        self._replies.append(LinkProblem("message" if code == "message" else "over", sentence))
        self._closing = (NOT_ALLOWED, close_reason(sentence))
        self._wake.set()

    def close_later(self) -> None:
        """Close the link, which is opened again: the class could not store what it sent."""
        self._closing = (TRY_LATER, _("the class can't save anything now"))
        self._wake.set()

    def stop(self) -> None:
        """End the task; nobody reads any more."""
        if self._task is not None:
            self._task.cancel()

    async def run(self) -> None:
        """Send messages until the end."""
        self._task = asyncio.current_task()
        with suppress(WebSocketDisconnect, RuntimeError):  # the other side has left
            while True:
                await self._wake.wait()
                self._wake.clear()
                replies, self._replies = self._replies, []
                for each in replies:
                    await self._socket.send_bytes(encode_from_class(each))
                while self._states:
                    kind = next(iter(self._states))
                    await self._socket.send_bytes(encode_from_class(self._states.pop(kind)))
                if self._closing is not None:
                    await self._socket.close(*self._closing)
                    return


async def _frame(socket: WebSocket) -> bytes:
    """Return the next binary frame.

    Raises:
        WebSocketDisconnect: the other side has left.
        WireError: it is text.
    """
    message = await socket.receive()
    if message["type"] != "websocket.receive":
        raise WebSocketDisconnect(message.get("code", 1006))
    data: bytes | None = message.get("bytes")
    if data is None:
        raise WireError("expected a binary message, got text")
    return data


def _decoded(frame: bytes) -> FromRoom:
    """Return a message after the hello.

    Raises:
        WireError: there is none in the frame, or another hello, or it is too large.
    """
    message = decode_from_room(frame)
    if isinstance(message, LinkHello):
        raise WireError(_("expected hello as the first message only"))
    if len(frame) > MAX_STATE_BYTES and isinstance(message, Drawing | Poses | State):
        raise WireError(
            _("expected at most {most} bytes, got {n}", most=MAX_STATE_BYTES, n=len(frame))
        )
    return message


async def _refuse(socket: WebSocket, problem: LinkProblem) -> None:
    if socket.application_state is WebSocketState.CONNECTED:
        await socket.send_bytes(encode_from_class(problem))
        await socket.close(NOT_ALLOWED, close_reason(problem.text))
