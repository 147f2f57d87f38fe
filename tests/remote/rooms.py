"""Worlds for scripts on other machines, and a script that speaks frame by frame."""

import socket
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Self

from gymnasium.spaces import Box
from websockets.exceptions import ConnectionClosed

from ai4u_edu import (
    Actuator,
    BasicAgent,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RewardFunc,
    Sensor,
    World,
    remote,
)
from ai4u_edu.page.server.scripts import Rules
from ai4u_edu.wire import native
from tests.builders import still
from tests.page.server.rooms import Room, open_socket, served
from tests.waiting import LIMIT_MS, LIMIT_S

SECRET = "a secret of the tests"
LARGEST = 1e9


class Place(Sensor):
    """[episode, step] of the agent."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self._agent = agent

    def space(self) -> Box:
        return Box(0.0, LARGEST, (2,))

    def read(self, body: Any, view: Any) -> Any:
        return [self._agent.episode, self._agent.steps]


class Log(Actuator):
    """Writes down each number that it is given, with the episode and the step."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self._agent = agent
        self.entries: list[tuple[int, int, float]] = []

    def space(self) -> Box:
        return Box(0.0, LARGEST, (1,))

    def act(self, body: Any, action: tuple[float, ...]) -> None:
        self.entries.append((self._agent.episode, self._agent.steps, action[0]))


class Pay(RewardFunc):
    """One for each decision."""

    def on_update(self, body: Any, view: Any) -> float:
        return 1.0


def log_sim(
    agents: int = 1, *, max_steps: int = 0, skip_frame: int = 0, sensors: Sequence[Sensor] = ()
) -> ControlRequestor:
    """Agents "a", "b", ... that write down what they are told to do; the first has more sensors."""
    world = World()
    crew = []
    for number in range(agents):
        name = "abcdefgh"[number]
        world.add_body(name, CircleShape(radius=0.3), position=(0.0, 2.0 * number))
        crew.append(
            BasicAgent(
                id=name,
                body=name,
                max_steps_per_episode=max_steps,
                sensors=[Place(), *(sensors if number == 0 else ())],
                actuators=[Log()],
                rewards=[Pay()],
                brains=[LocalBrain(controller=still, skip_frame=skip_frame)],
            )
        )
    return ControlRequestor(world, crew)


def log_of(room: Room, agent_id: str = "a") -> list[tuple[int, int, float]]:
    """Return the actions of an agent, as (episode, step, number)."""
    log = room.sim.agent(agent_id).actuators[0]
    assert isinstance(log, Log)
    return log.entries


def patient_rules(**changes: Any) -> Rules:
    """Return rules whose time limits only a fault reaches."""
    limits = {"grace": LIMIT_S, "receive_timeout": int(LIMIT_MS), "hello_timeout": LIMIT_S}
    return Rules(**(limits | changes))


@contextmanager
def unused_address() -> Iterator[str]:
    """Yield a host and a TCP port at which nobody listens, and nobody can begin to."""
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        host, port = bound.getsockname()
        yield f"{host}:{port}"


def connect(url: str, agent: str = "", **options: Any) -> remote.Robot:
    """Connect like :func:`ai4u_edu.remote.connect`; a busy world may take long to answer."""
    return remote.connect(url, agent, **({"patience": LIMIT_S} | options))


@contextmanager
def log_room(
    agents: int = 1,
    *,
    max_steps: int = 0,
    skip_frame: int = 0,
    time_scale: float = float("inf"),
    port: int = 0,
    **rules: Any,
) -> Iterator[Room]:
    """A room of such agents, as fast as it goes; its scripts may have it wait.

    Args:
        port: to listen at; 0 for any free one.
        rules: changes of :func:`patient_rules`.
    """
    sim = log_sim(agents, max_steps=max_steps, skip_frame=skip_frame)
    with served(sim, port=port, rules=patient_rules(**({"lockstep": True} | rules))) as room:
        room.runner.scale_time(time_scale)
        yield room


class Script:
    """A script that says and hears one frame at a time, and repeats nothing by itself."""

    def __init__(
        self, room: Room, *, subprotocol: str | None = native.SUBPROTOCOL, query: str = ""
    ) -> None:
        names: Any = [subprotocol] if subprotocol else None
        self.socket = open_socket(
            f"{room.url}ws/remote{query}",
            subprotocols=names,
            compression=None,
            # real time: a script that reads nothing waits in vain, and no test needs the answer
            close_timeout=1,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def say(self, message: native.Message) -> None:
        self.socket.send(native.encode(message))

    def hello(self, **changes: Any) -> native.Message:
        """Says hello, and gives back the answer."""
        fields: dict[str, Any] = {
            "version": native.VERSION,
            "agent": "a",
            "token": "",
            "mode": "lockstep",
            "keys": (),
            "session": "",
            "secret": SECRET,
        }
        self.say(native.Hello(**(fields | changes)))
        return self.hear()

    def hear(self) -> native.Message:
        return native.decode(self.socket.recv(LIMIT_S, decode=False), native.MAX_WORLD_FRAME_BYTES)

    def percept(self) -> native.Percept:
        message = self.hear()
        assert isinstance(message, native.Percept), message
        return message

    def act(self, percept: native.Percept, number: float, **changes: int) -> None:
        fields: dict[str, Any] = {
            "episode": percept.episode,
            "step": percept.step,
            "seq": percept.seq,
        }
        self.say(native.Action(**(fields | changes), values={"log": (number,)}))

    def end(self) -> tuple[int, str]:
        """Wait for the world to close the connection, and return the code and the reason."""
        while True:
            try:
                self.socket.recv(LIMIT_S)
            except ConnectionClosed as closed:
                return (closed.rcvd.code, closed.rcvd.reason) if closed.rcvd else (1006, "")
