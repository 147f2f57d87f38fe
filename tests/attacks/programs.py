"""Servers in processes of their own, and the many connections of those who attack them."""

import asyncio
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self
from urllib.parse import urlsplit

from tests.waiting import LIMIT_S, until_async

RETRY_S = 2
"""Time after which those who attack open a connection that was closed again."""

PROGRAM = """
import sys
from dataclasses import replace
from math import inf
import viser
from ai4u_edu import WASDRBMoveController
from ai4u_edu.blocks import Keyboard
from ai4u_edu.recording import Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.page.server import room_app, serve
from ai4u_edu.runtime import tick_monitor
from tests.builders import small_sim
from tests.page.server.rooms import PATIENT
from tests.waiting import LIMIT_S

# What a busy machine may reach keeps nobody from anything. Idle connections are closed as usual,
# and apps that do not return in time at the end are told in the log.
Keyboard.timeout_s, tick_monitor.STALL_S = inf, LIMIT_S
timeouts = replace(PATIENT, request=5.0, shutdown=LIMIT_S)
sim = small_sim(controller=WASDRBMoveController())
recorder = Recorder(sim)
runner = Runner(sim, seed=1, recorder=recorder)
for seed in range(int(sys.argv[1])):
    for _ in range(300):
        sim.step()
    sim.reset(seed)
runner.start()
inner = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
app = room_app(runner, viser_port=inner.get_port(), title="A room", timeouts=timeouts)
announce = lambda url: print("READY", url, flush=True)
serve(app, "127.0.0.1", 0, announce, timeouts=timeouts)
runner.stop(LIMIT_S)
print("ENDED", flush=True)
"""


@dataclass
class Program:
    """A server in a process of its own."""

    process: subprocess.Popen[str]
    url: str
    log: Path

    def terminate(self) -> tuple[int, str]:
        """End it by one SIGTERM; returns its exit status and what it wrote last."""
        self.process.send_signal(signal.SIGTERM)
        said, _ = self.process.communicate(timeout=LIMIT_S)
        return self.process.returncode, said

    def log_lines(self) -> list[str]:
        return self.log.read_text().splitlines()


@contextmanager
def program(folder: Path, *, episodes: int = 0, descriptors: int = 1024) -> Iterator[Program]:
    """A served room with kept episodes, in a process with a limit of descriptors."""
    log = folder / "log"
    command = f'ulimit -n {descriptors}; exec "$0" "$@"'
    with log.open("w") as file:
        process = subprocess.Popen(
            ["/bin/sh", "-c", command, sys.executable, "-c", PROGRAM, str(episodes)],
            stdout=subprocess.PIPE,
            stderr=file,
            text=True,
        )
    try:
        assert process.stdout is not None
        said = next((line for line in process.stdout if line.startswith("READY")), "")
        assert said, log.read_text()
        yield Program(process, said.split()[1], log)
    finally:
        process.kill()
        process.communicate()


@contextmanager
def many_descriptors(wanted: int) -> Iterator[None]:
    """Let this process have ``wanted`` descriptors for a while."""
    import resource  # not there on Windows

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    enough = soft if hard != resource.RLIM_INFINITY and hard < wanted else max(soft, wanted)
    resource.setrlimit(resource.RLIMIT_NOFILE, (enough, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


@dataclass
class Crowd:
    """Connections that are opened again as soon as they are closed; an async context manager.

    Args:
        url: of the server.
        count: of the connections.
        said: what each of them says, one after another; then it waits.
    """

    url: str
    count: int
    said: Sequence[bytes]
    opened: int = 0
    """Connections so far."""
    _tasks: list[asyncio.Task[None]] = field(default_factory=list)

    async def __aenter__(self) -> Self:
        self._tasks = [
            asyncio.create_task(self._connect(self.said[number % len(self.said)]))
            for number in range(self.count)
        ]
        return self

    async def __aexit__(self, *_: object) -> None:
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def until_opened(self, count: int) -> None:
        """Wait until there have been ``count`` connections."""
        await until_async(lambda: self.opened >= count)

    async def _connect(self, said: bytes) -> None:
        parts = urlsplit(self.url)
        while True:
            with suppress(OSError):
                reader, writer = await asyncio.open_connection(parts.hostname, parts.port)
                self.opened += 1
                try:
                    writer.write(said)
                    while await reader.read(4096):
                        pass
                finally:
                    writer.close()
            await asyncio.sleep(RETRY_S)  # real time: how often they attack; no test needs them to
