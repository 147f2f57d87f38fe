"""A script's side of AI4U's protocol, said by hand: for tests of what goes wrong."""

import contextlib
import socket
from collections.abc import Iterator
from typing import Any

from ai4u_edu import ControlRequestor
from ai4u_edu.wire.ai4u import decode_request
from tests.blocks.scripted_link import StillClock
from tests.waiting import LIMIT_S, Deadline

WAIT = "__waitnewaction__;1;0"
RESET = "__reset__;1;0"
NOOP = "__noop__;1;0"
TICK_S = 0.01
"""Time that passes with each tick by the clock of a script."""


class UDPScript:
    """Listens like an AI4U script; says only what a test has it say.

    Attributes:
        clock: for the brain of a world that :meth:`next` ticks; it passes with these ticks alone.
    """

    def __init__(self, port: int = 0) -> None:
        self.clock = StillClock()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", port))
        self.port: int = self._socket.getsockname()[1]
        self._world: Any = None

    def hear(self, timeout: float = LIMIT_S) -> dict[str, Any]:
        """The fields of the next request."""
        self._socket.settimeout(timeout)
        data, self._world = self._socket.recvfrom(2**16)
        return {field.name: field.value for field in decode_request(data)}

    def heard(self) -> dict[str, Any] | None:
        """The fields of a request that is there already."""
        with contextlib.suppress(BlockingIOError):
            return self.hear(timeout=0.0)
        return None

    def say(self, reply: str | bytes, *, times: int = 1) -> None:
        """Answers whoever asked last."""
        data = reply.encode() if isinstance(reply, str) else reply
        for _ in range(times):
            self._socket.sendto(data, self._world)

    def say_from_elsewhere(self, reply: str) -> None:
        """Says something to the world from another port."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.sendto(reply.encode(), self._world)

    def meet(self, sim: ControlRequestor, agent: str = "0") -> dict[str, Any]:
        """Goes through the beginning with an agent; gives the first state after the reset."""
        for expected, reply in (
            ("wait_command", NOOP),
            ("config", f"max_steps;1;0@id;1;{agent}"),
            ("wait_command", RESET),
        ):
            request = self.next(sim)
            assert expected in request, request
            self.say(reply)
        return self.next(sim)

    def next(self, sim: ControlRequestor) -> dict[str, Any]:
        """Lets the world tick until it asks something."""
        deadline = Deadline()
        while (request := self.heard()) is None:
            deadline.left()
            self.tick(sim)
        return request

    def tick(self, sim: ControlRequestor, seconds: float = TICK_S) -> None:
        """Let some time pass, and the world tick once."""
        self.clock.advance(seconds)
        sim.tick()

    def close(self) -> None:
        """Is gone: its port is free."""
        self._socket.close()


@contextlib.contextmanager
def udp_script(port: int = 0) -> Iterator[UDPScript]:
    script = UDPScript(port)
    try:
        yield script
    finally:
        script.close()
