"""A served scene in a process of its own."""

import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx
from websockets.sync.client import connect
from websockets.typing import Origin

from tests import evidence
from tests.waiting import LIMIT_S, until


@dataclass(eq=False)
class Played:
    """A running ``ai4u-edu play``."""

    process: subprocess.Popen[str]
    url: str
    told: list[str] = field(default_factory=list)
    """Every line that it wrote."""

    def __post_init__(self) -> None:
        evidence.register(self)

    def testify(self) -> dict[str, str | bytes]:
        """Return its output, and the world's present state if it still answers."""
        files: dict[str, str | bytes] = {"play.log": "".join(self.told)}
        with contextlib.suppress(OSError):
            # real time: a world that does not answer soon has nothing to say
            files["snapshot.json"] = json.dumps(self._get("api/snapshot", timeout=5), indent=1)
        return files

    def snapshot(self) -> dict[str, Any]:
        """Return the answer of ``/api/snapshot``."""
        return self._get("api/snapshot")

    def health(self) -> dict[str, Any]:
        """Return the answer of ``/healthz``, whatever its status."""
        return self._get("healthz")

    def open(self, scene: str) -> None:
        """Open a scene of the library in place of the present one, whatever was changed there."""
        answer = httpx.post(f"{self.url}api/scene", json={"name": scene}, timeout=LIMIT_S)
        answer.raise_for_status()

    def restart(self, seed: int) -> None:
        """Begin a new episode of the scene, and let the world run."""
        episode = self.snapshot()["episode"]
        url = self.url.replace("http", "ws", 1) + "ws/input"
        with connect(url, origin=Origin(self.url.rstrip("/")), proxy=None) as page:
            page.send(json.dumps({"type": "do", "id": 0, "command": "resume"}))
            command = {"type": "do", "id": 0, "command": "seed", "seed": str(seed)}
            page.send(json.dumps(command))
            until(lambda: (now := self.snapshot())["episode"] != episode and not now["paused"])

    def _get(self, path: str, timeout: float = LIMIT_S) -> dict[str, Any]:
        try:
            answer = urllib.request.urlopen(f"{self.url}{path}", timeout=timeout)  # noqa: S310 - our own
        except urllib.error.HTTPError as error:
            answer = error
        with answer:
            found: dict[str, Any] = json.load(answer)
            return found


@contextlib.contextmanager
def played(
    *args: str,
    waits_for_key: bool = False,
    program: Sequence[str] = ("-m", "ai4u_edu"),
    state: Path | None = None,
) -> Iterator[Played]:
    """Serve a scene: ``played("box_chase", "--seed", "1")``.

    Args:
        args: arguments of ``ai4u-edu play``.
        waits_for_key: True lets the world wait for a person's first key.
        program: Python's arguments that run the command line.
        state: the user's state folder; by default one that is deleted at the end.
    """
    wait = "--wait-for-key" if waits_for_key else "--no-wait-for-key"
    command = [sys.executable, *program, "play", *args, "--port", "0", "--no-open", wait]
    with contextlib.ExitStack() as stack:
        home = state or stack.enter_context(tempfile.TemporaryDirectory(ignore_cleanup_errors=True))
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            bufsize=1,
            env=os.environ | {"XDG_STATE_HOME": str(home)},
        )
        told: list[str] = []

        def listen() -> None:
            with process:  # closes its output, and waits for its end
                told.extend(process.stdout or ())  # line by line, as they come

        listener = threading.Thread(target=listen)
        listener.start()
        try:
            yield Played(process, _url(process, told), told)
        finally:
            process.terminate()
            listener.join(LIMIT_S)


def _url(process: subprocess.Popen[str], told: list[str]) -> str:
    until(lambda: process.poll() is not None or "http://" in "".join(told))
    found = re.search(r"http://\S+", "".join(told))
    if not found:
        raise RuntimeError("the scene was not served: " + "".join(told))
    return found[0].rstrip("/") + "/"
