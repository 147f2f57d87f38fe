"""A notebook as a member of a class: its seat, its link, and the part that a shown world uses."""

import secrets
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Condition, Lock
from typing import Literal, NamedTuple
from urllib.parse import quote

from msgspec.structs import replace

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.client import LinkClient
from ai4u_edu.member.dialogue import PresentState
from ai4u_edu.member.joining import Seat, SeatFile, join_at_hub
from ai4u_edu.member.link import LinkTimeouts, Receive
from ai4u_edu.member.outbox import ResultOutbox
from ai4u_edu.scenes import Scene
from ai4u_edu.wire.class_link import (
    MAX_NETWORK_BYTES,
    Applied,
    Assignment,
    Attention,
    ClassSettings,
    CurrentRace,
    Delivery,
    ExerciseResult,
    FromClass,
    HandedIn,
    HandedInNetwork,
    LinkProblem,
    LinkWelcome,
    People,
    State,
)

NO_WORLD = _("The notebook shows no world at present.")
_REPLAYED = (LinkWelcome, People, Attention, ClassSettings, CurrentRace)
"""Messages of which a world that is shown later gets the latest one. Of assignments it gets only a
lesson's: a scene would replace the world that a cell has just shown."""


class SubmissionAnswer(NamedTuple):
    """Answer of the class to a network that was handed in."""

    is_stored: bool = False
    is_checked: bool = False
    """True if it can play."""
    refusal: str = ""
    """Sentence on why it can't."""


class ClassConnection:
    """Keeps one link with the class, whatever worlds come and go.

    Args:
        seat: of the notebook.
        folder: of the seat's files; made if needed.
        timeouts: of the link; default: those for a school's network.
        clock: seconds, for the time to wait for the class's check.
    """

    def __init__(
        self,
        seat: Seat,
        folder: Path,
        *,
        timeouts: LinkTimeouts | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.seat, self.folder = seat, folder
        self._clock = clock
        outbox = ResultOutbox(folder / "outbox")
        self.client = LinkClient(seat.url, seat.token, "notebook", self._receive, outbox, timeouts)
        self._assignment = ""
        """Id of the latest assignment; the class sends it again after each reconnect."""
        self._lock = Lock()
        self._changed = Condition(self._lock)
        """Notified when the class has said something of networks."""
        self._handed_in = HandedIn(())
        self._problem = ""
        """Problem with the latest network."""
        self._latest: dict[type, FromClass] = {}
        self._world: Receive | None = None

    def start(self) -> None:
        """Connect, in the background."""
        with suppress(OSError):  # the outbox says so
            self.folder.mkdir(parents=True, exist_ok=True)
        self.client.start()

    def stop(self) -> None:
        """Deliver what can be delivered soon, and end the link."""
        self.client.stop()

    def report(
        self, exercise: str, event: Literal["right", "wrong", "hint"], diagnosis: str = ""
    ) -> None:
        """Tell the class of a check or a hint.

        Args:
            exercise: its id.
            event: result of the check, or that a hint was read.
            diagnosis: id of the mistake that was found, such as ``04.2/narrow``.
        """
        self.client.renew()  # another notebook of this seat may have taken its place
        key = secrets.token_urlsafe(12)
        self.client.send_result(ExerciseResult(key, exercise, event, diagnosis))

    def hand_in(self, network: HandedInNetwork, timeout_s: float) -> SubmissionAnswer:
        """Deliver a network, and wait for the class's check.

        Args:
            network: the network.
            timeout_s: longest time to wait (s); the network is delivered afterwards, too.
        """
        with self._lock:
            self._problem = ""
        self.client.renew()  # another notebook of this seat may have taken its place
        self.client.send_result(network)
        end_at = self._clock() + timeout_s
        with self._changed:
            while True:
                answer = self._answer(network.key)
                left_s = end_at - self._clock()
                is_lost = not answer.is_stored and not self.client.is_connected
                is_lost = is_lost and bool(self.client.problem)
                if answer.is_checked or answer.refusal or is_lost or left_s <= 0:
                    return answer
                self._changed.wait(min(left_s, 0.25))  # a lost connection notifies nobody

    def _answer(self, key: str) -> SubmissionAnswer:
        for each in self._handed_in.networks:
            if each.key == key:
                return SubmissionAnswer(True, each.verdict == "right", each.reason)
        is_stored = key not in self.client.outbox.keys()  # noqa: SIM118 - it is no mapping
        return SubmissionAnswer(is_stored, False, self._problem if is_stored else "")

    def link_for_world(self, receive: Receive) -> "WorldLink":
        """Return a link for a world.

        Args:
            receive: called with the class's messages while the world's link is started.
        """
        return WorldLink(self, receive)

    def attach(self, receive: Receive) -> None:
        """Pass the class's messages on to a world, from the latest ones on."""
        with self._lock:
            self._world = receive
            for message in self._latest.values():
                receive(message)

    def detach(self, receive: Receive, last: State | None) -> None:
        """End what :meth:`attach` began.

        Args:
            receive: as it was given.
            last: latest state of the world, if there was one.
        """
        with self._lock:
            if self._world == receive:
                self._world = None
                self.client.clear()
                if last is not None:  # else the teacher's page would show it as driving on
                    self.client.send(replace(last, status="over", error="", page=""))

    def _receive(self, message: FromClass) -> None:
        with self._lock:
            if isinstance(message, Assignment):
                self._assign(message)
                return
            if isinstance(message, HandedIn):
                self._handed_in = message
                self._changed.notify_all()
            if isinstance(message, LinkProblem):
                self._problem = message.text
            if isinstance(message, _REPLAYED):
                self._latest[type(message)] = message
            if self._world is not None:
                self._world(message)

    def _assign(self, message: Assignment) -> None:
        if message.id == self._assignment:
            return
        self._assignment = message.id
        self._latest.pop(Assignment, None)
        if message.lesson:  # the lesson's notebook shows its worlds by itself
            message = self._latest[Assignment] = replace(message, scene="", seed=None)
        if self._world is not None:
            self._world(message)
        else:
            self.client.send(Applied(message.id, "" if message.lesson else NO_WORLD))


class WorldLink:
    """Link of one world over the notebook's connection.

    Args:
        connection: of the notebook.
        receive: called with the class's messages, from :meth:`start` to :meth:`stop`.
    """

    def __init__(self, connection: ClassConnection, receive: Receive) -> None:
        self._connection, self._receive = connection, receive
        self._is_started = False
        self._last: State | None = None

    @property
    def is_connected(self) -> bool:
        """True while the class has accepted the link."""
        return self._is_started and self._connection.client.is_connected

    def start(self) -> None:
        """Begin to receive and to send."""
        self._is_started = True
        self._connection.attach(self._receive)

    def stop(self, timeout_s: float = 2.0) -> None:  # noqa: ARG002 - the connection stays
        """End receiving and sending; the notebook's connection stays."""
        self._is_started = False
        self._connection.detach(self._receive, self._last)

    def send(self, message: PresentState) -> None:
        """Send a present state of the world."""
        if self._is_started:
            self._last = message if isinstance(message, State) else self._last
            self._connection.client.send(message)

    def send_result(self, result: Delivery) -> None:
        """Deliver a result."""
        self._connection.client.send_result(result)


def join_notebook(
    url: str, code: str, name_choice: int, service: str, folder: Path
) -> ClassConnection:
    """Take the seat of a notebook, and return its connection, which is not started.

    Args:
        url: address of the class; empty on a JupyterHub.
        code: join code.
        name_choice: number of the name to get among those that the class offers, from 1.
        service: name of the class's service on a JupyterHub.
        folder: of the notebook's files; the same one gives the same seat.

    Raises:
        NotJoinedError: the class gives no seat; the message says why.
    """
    if url:
        seats = SeatFile(folder / "class.json")
        seat = seats.take(url, code, name_choice, "notebook")
        return ClassConnection(seat, seats.folder(seat))
    # the token is another one after each start of the server; what was not delivered has to stay
    place = folder / f"class-at-hub-{quote(service, safe='')}"
    return ClassConnection(join_at_hub(service), place)


def network_in(path: Path, scene: str, part: str) -> HandedInNetwork:
    """Return the message with which a network is handed in.

    Args:
        path: of its ONNX file.
        scene: name of the tournament's scene.
        part: role or side that it drives; empty for all agents.

    Raises:
        SetupError: it can't be handed in; a sentence for the student.
    """
    names = Scene.names()
    if scene not in names:
        raise SetupError(
            _(
                "Expected the name of a scene, got {scene!r}; {hint}.",
                scene=scene,
                hint=suggest(scene, names),
            )
        )
    if path.suffix.lower() != ".onnx":
        raise SetupError(
            _(
                "Expected a network as an .onnx file, got {name!r}. A training writes one.",
                name=path.name,
            )
        )
    try:
        data = path.read_bytes()
    except OSError as error:
        raise SetupError(
            _(
                "{path} can't be read: {reason}. Is it in this notebook's folder?",
                path=str(path),
                reason=error.strerror or "",
            )
        ) from None
    if not 0 < len(data) <= MAX_NETWORK_BYTES:
        limit = MAX_NETWORK_BYTES // 2**20
        raise SetupError(
            _(
                "{name}: expected 1 byte to {limit} MB, got {n:,} bytes.",
                name=path.name,
                limit=limit,
                n=len(data),
            )
        )
    return HandedInNetwork(secrets.token_urlsafe(12), scene, part, path.name[-100:], data)
