"""A link without a network, and worlds that are members of its class."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from ai4u_edu.member import ClassMember, Receive
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.recording import Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from ai4u_edu.wire.class_link import (
    Delivery,
    EpisodeResult,
    FromClass,
    FromRoom,
    State,
    decode_from_room,
    encode_from_room,
)
from tests.waiting import LIMIT_S, until

M = TypeVar("M")
ASKED_PER_POLL = 2
"""Number of times that a member asks its link in a poll if it is connected."""


class FakeLink:
    """Keeps what a member sends; each message goes through the codec, which checks its limits."""

    def __init__(self, receive: Receive) -> None:
        self.receive = receive
        self.sent: list[FromRoom] = []
        self.results: list[Delivery] = []
        self._is_connected = True
        self.asked = 0
        """Number of times that the member has asked for a link: a few in each poll."""
        self.is_stopped = False

    @property
    def is_connected(self) -> bool:
        self.asked += 1
        return self._is_connected

    @is_connected.setter
    def is_connected(self, is_connected: bool) -> None:
        self._is_connected = is_connected

    def start(self) -> None:
        pass

    def stop(self, timeout_s: float = 2.0) -> None:
        self.is_stopped = True

    def send(self, message: FromRoom) -> None:
        assert decode_from_room(encode_from_room(message)) == message
        self.sent.append(message)

    def send_result(self, result: Delivery) -> None:
        assert decode_from_room(encode_from_room(result)) == result
        self.results.append(result)

    def of(self, kind: type[M]) -> list[M]:
        """Return all messages of a kind."""
        return [each for each in [*self.sent, *self.results] if isinstance(each, kind)]


@dataclass
class Joined:
    """A running world in a class."""

    runner: Runner
    editor: SceneEditor
    member: ClassMember
    link: FakeLink
    clock: "Clock"
    ghosts: list[Any] = field(default_factory=list)

    def tell(self, *messages: FromClass) -> None:
        for message in messages:
            self.link.receive(message)

    def poll(self) -> None:
        """Wait until the member has polled once from its beginning to its end."""
        polls, asked = 2, self.link.asked
        until(lambda: self.link.asked > asked + polls * ASKED_PER_POLL)

    def next(self, kind: type[M], condition: Callable[[M], bool] = lambda _: True) -> M:
        """Wait for a message of a kind that meets a condition; return the first one."""
        found: list[M] = []

        def is_there() -> bool:
            found[:] = [each for each in self.link.of(kind) if condition(each)]
            return bool(found)

        until(is_there)
        return found[0]

    def state(self, **wanted: Any) -> State:
        """Wait for a state with these values."""
        return self.next(
            State, lambda state: all(getattr(state, name) == wanted[name] for name in wanted)
        )

    def episode_result(self, number: int = 0) -> EpisodeResult:
        until(lambda: len(self.link.of(EpisodeResult)) > number)
        return self.link.of(EpisodeResult)[number]


@dataclass
class Clock:
    """Seconds that a test sets."""

    now: float = 1000.0

    def __call__(self) -> float:
        return self.now


@contextmanager
def joined(
    scene: str = "box_chase",
    folder: Path | None = None,
    *,
    wait_for_key: bool = False,
    time_scale: float | None = None,
) -> Iterator[Joined]:
    """Run a scene as a member of a class."""
    described = Scene.load(scene)
    sim = described.build()
    recorder = Recorder.into(None, sim, described, 10)
    runner = Runner(
        sim, seed=1, recorder=recorder, wait_for_key=wait_for_key, time_scale=time_scale
    )
    editor = SceneEditor(runner, described)
    if folder is not None:
        folder.mkdir(exist_ok=True)
        editor.scene_store = SceneStore(folder / "scenes")
    clock, ghosts = Clock(), list[Any]()
    member = ClassMember(
        runner,
        editor,
        FakeLink,
        folder,
        show_ghosts=ghosts.append,
        clock=clock,
        open_timeout=LIMIT_S,
    )
    assert isinstance(member.link, FakeLink)
    runner.start()
    member.start()
    try:
        yield Joined(runner, editor, member, member.link, clock, ghosts)
    finally:
        member.stop()
        runner.stop(LIMIT_S)
    assert member.link.is_stopped
