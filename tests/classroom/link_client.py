"""A raw link to a class, and a teacher's socket: what is sent and received, message by message."""

import json
from collections.abc import Callable
from itertools import count
from typing import Any, Self, TypeVar

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    PATH,
    SUBPROTOCOL,
    VERSION,
    ExerciseResult,
    FromClass,
    FromRoom,
    HandedIn,
    LinkHello,
    LinkProblem,
    State,
    decode_from_class,
    encode_from_room,
)
from tests.classroom.fake_hub import HubClass
from tests.classroom.served_class import ServedClass, Student
from tests.page.server.rooms import open_socket
from tests.waiting import Deadline

M = TypeVar("M")
_keys = count(1)


class RawLink:
    """A link that says hello with any secret, and then sends what a test gives it."""

    def __init__(
        self,
        served: ServedClass | HubClass,
        secret: str | Student,
        *,
        hello: FromRoom | None = None,
    ) -> None:
        if isinstance(secret, Student):
            secret = secret.token
        self.socket = open_socket(
            served.url.rstrip("/") + PATH,
            subprotocols=[Subprotocol(SUBPROTOCOL)],
            max_size=MAX_FRAME_BYTES,
        )
        self.received: list[FromClass] = []
        self.send(hello or LinkHello(VERSION, secret, "room"))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def send(self, message: FromRoom) -> None:
        self.socket.send(encode_from_room(message))

    def next(self, kind: type[M], fits: Callable[[M], bool] = lambda _: True) -> M:
        """Return the next message of a kind, for which a condition holds."""
        deadline = Deadline()
        while True:
            message = decode_from_class(self.socket.recv(deadline.left(), decode=False))
            self.received.append(message)
            if isinstance(message, kind) and fits(message):
                return message

    def end(self) -> tuple[int, LinkProblem | None]:
        """Wait for the end; return the close's code, and the last problem."""
        with pytest.raises(ConnectionClosed) as closed:
            self.receive_all()
        assert closed.value.rcvd is not None
        problems = [each for each in self.received if isinstance(each, LinkProblem)]
        return closed.value.rcvd.code, problems[-1] if problems else None

    def receive_all(self) -> None:
        """Receive messages until the link is closed, which raises an error."""
        deadline = Deadline()
        while True:
            frame = self.socket.recv(deadline.left(), decode=False)
            self.received.append(decode_from_class(frame))


def wait_for_verdicts(served: ServedClass, student: Student) -> None:
    """Wait until all networks of a student were checked."""
    with RawLink(served, student) as link:
        link.next(HandedIn, lambda told: all(each.verdict != "open" for each in told.networks))


class TeacherSocket:
    """The socket of the teacher's page, or of the projector page."""

    def __init__(self, served: ServedClass, page: str = "teacher", language: str = "en") -> None:
        headers = {"Authorization": f"Bearer {served.token}", "Accept-Language": language}
        self.socket = open_socket(f"{served.url}{page}/socket", additional_headers=headers)
        self._waiting: list[dict[str, Any]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def next(
        self, kind: str, fits: Callable[[dict[str, Any]], Any] = lambda _: True
    ) -> dict[str, Any]:
        """Return the next event of a kind, for which a condition holds; others wait."""
        for index, found in enumerate(self._waiting):
            if found["type"] == kind and fits(found):
                return self._waiting.pop(index)
        deadline = Deadline()
        while True:
            event: dict[str, Any] = json.loads(self.socket.recv(deadline.left()))
            if event["type"] == kind and fits(event):
                return event
            self._waiting.append(event)


def state(**changes: Any) -> State:
    """Return a state of a room."""
    plain: dict[str, Any] = {
        "status": "driving",
        "scene": "Box chase",
        "driver": "A person",
        "seconds": 1.5,
        "episodes": 1,
        "falls": 0,
        "is_solved": False,
    }
    return State(**(plain | changes))


def key() -> str:
    """Return another key of a result."""
    return f"key-{next(_keys):08}"


def check(event: str, diagnosis: str = "", exercise: str = "04.2", own: str = "") -> ExerciseResult:
    """Return the result of a check."""
    return ExerciseResult(own or key(), exercise, event, diagnosis)  # type: ignore[arg-type]
