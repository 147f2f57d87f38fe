"""Whole conversations with the sockets for scripts and for pages, in the process.

The world is let go on between two frames by hand, so that what happens depends on the seed
alone.
"""

import asyncio
import json
import math
import random
from functools import cache
from typing import Any

from starlette.applications import Starlette

from ai4u_edu.page.server import room_app
from ai4u_edu.page.server.scripts import Rules
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native
from tests.fuzz.decoders import make_frame, make_words
from tests.fuzz.messages import KINDS, example
from tests.fuzz.requests import loop
from tests.fuzz.target import MANY, Target
from tests.remote.rooms import LARGEST, Log, log_sim
from tests.waiting import LIMIT_S

FRAMES = 20
"""Frames of a conversation, on average."""


@cache
def _room() -> tuple[Runner, Starlette]:
    runner = Runner(log_sim(2, max_steps=5), seed=1, time_scale=math.inf)
    rules = Rules(grace=0.0, lockstep=True)
    return runner, room_app(runner, viser_port=9, title="A room", rules=rules)


class Talk:
    """One connection whose client sends random messages."""

    def __init__(self, rng: random.Random) -> None:
        self.rng = rng
        self.is_remote = rng.random() < 0.8
        self.percept: native.Percept | None = None
        self.closed = False
        self._left = rng.randrange(2 * FRAMES)
        self._hello = self._right_hello()
        self._started = False

    def scope(self) -> dict[str, Any]:
        subprotocols = [native.SUBPROTOCOL] if self.rng.random() < 0.97 else ["other.v1"]
        return {
            "type": "websocket",
            "asgi": {"version": "3.0"},
            "scheme": "ws",
            "path": "/ws/remote" if self.is_remote else "/ws/input",
            "raw_path": b"",
            "root_path": "",
            "query_string": self.rng.choice((b"", b"", b"agent=a", b"agent=x", b"agent=%ff&&")),
            "headers": [(b"host", b"localhost")],
            "subprotocols": subprotocols,
            "extensions": {},
            "client": ("127.0.0.1", 1),
            "server": ("127.0.0.1", 80),
        }

    async def receive(self) -> dict[str, Any]:
        if not self._started:
            self._started = True
            return {"type": "websocket.connect"}
        for _ in range(self.rng.choice((1, 3, 3, 6))):
            await asyncio.sleep(0)
        self._left -= 1
        if self._left < 0 or self.closed:
            return {"type": "websocket.disconnect", "code": 1006}
        if self.is_remote:
            return {"type": "websocket.receive", "bytes": self._frame()}
        words = make_words(self.rng)
        if self.rng.random() < 0.1:
            return {"type": "websocket.receive", "bytes": words}
        return {"type": "websocket.receive", "text": words.decode(errors="replace")}

    async def send(self, message: Any) -> None:
        if message["type"] == "websocket.close":
            self.closed = True
            assert len(message.get("reason", "").encode()) <= 123, message
        elif message.get("bytes") is not None:
            heard = native.decode(message["bytes"], native.MAX_WORLD_FRAME_BYTES)
            if isinstance(heard, native.Percept):
                self.percept = heard
        elif message.get("text") is not None:
            json.loads(message["text"])

    def _right_hello(self) -> native.Message:
        mode: native.Mode = self.rng.choice(("lockstep", "realtime"))
        on_missing: native.OnMissing = self.rng.choice(("", "hold", "coast", "stop"))
        return native.Hello(native.VERSION, "a", "", mode, (), "", "s" * 20, on_missing)

    def _frame(self) -> bytes:
        roll = self.rng.random()
        if self.percept is None:
            return make_frame(self.rng) if roll < 0.1 else native.encode(self._hello)
        if roll < 0.15:
            return make_frame(self.rng)
        if roll < 0.3:
            return native.encode(example(self.rng.choice(KINDS), self.rng))
        if roll < 0.5 and not self.percept.terminated and not self.percept.truncated:
            number = self.rng.choice((1.0, -5.0, 1e300, math.nan, math.inf, 3.0))
            percept = self.percept
            return native.encode(
                native.Action(percept.episode, percept.step, percept.seq, {"log": (number,)})
            )
        if roll < 0.6:
            return native.encode(native.Reset(self.percept.seq, self.rng.choice((None, 3))))
        seq = max(0, self.percept.seq + self.rng.choice((-1, 0, 0, 1)))
        return native.encode(native.Action(1, self.rng.randrange(3), seq, {"log": (2.0,)}))


async def _go_on(runner: Runner) -> None:
    while True:
        if runner.paused:  # or it would rest for a while
            runner.resume()
        runner.advance()
        await asyncio.sleep(0)


async def _talk(rng: random.Random) -> None:
    runner, app = _room()
    talk = Talk(rng)
    world = asyncio.create_task(_go_on(runner))
    try:
        await asyncio.wait_for(app(talk.scope(), talk.receive, talk.send), LIMIT_S)
        for _ in range(20):  # the seat becomes free, and the agent goes back to its own brain
            await asyncio.sleep(0)
    finally:
        world.cancel()
    assert not runner.error, runner.error
    for agent in runner.sim.agents:
        (log,) = agent.actuators
        assert isinstance(log, Log)
        assert all(0 <= number <= LARGEST for _, _, number in log.entries), log.entries
        log.entries.clear()
        assert type(agent.brain).__name__ == "LocalBrain", "the seat is not free"
        assert len(agent.brains) == 1


def make_talk(rng: random.Random) -> bytes:
    """Return the seed of a conversation."""
    return rng.randbytes(8)


def read_talk(data: bytes) -> None:
    """Hold it: the world runs on, no invalid number reaches it, and the agent is released."""
    loop().run_until_complete(_talk(random.Random(data)))


TALK = Target("conversations", make_talk, read_talk, (), count=MANY // FRAMES)
"""Conversations of about ``FRAMES`` frames each."""
