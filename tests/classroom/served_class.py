"""A class in a process of its own, and its students and teacher over HTTP."""

import contextlib
import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import httpx

from ai4u_edu.member.joining import SEAT_COOKIE
from tests import evidence
from tests.classroom.patient_class import OPTION
from tests.page.server import http_client
from tests.waiting import LIMIT_S

CODE = "BCDFG"
MODULE = "tests.classroom.patient_class"
_requests = count(1)


@dataclass(eq=False)
class ServedClass:
    """A running ``ai4u-edu class``."""

    process: subprocess.Popen[str]
    url: str
    """Address of the class on this machine, with a slash at the end."""
    token: str
    """Secret of the teacher's page."""
    folder: Path
    told: list[str] = field(default_factory=list)
    clients: list[httpx.Client] = field(default_factory=list)
    """Clients of the students, which are closed at the end."""

    def __post_init__(self) -> None:
        evidence.register(self)

    def testify(self) -> dict[str, str | bytes]:
        """Return the class's output."""
        return {"class.log": "".join(self.told)}

    def student(self) -> "Student":
        """Return a browser that has not joined."""
        self.clients.append(http_client.Client(base_url=self.url))
        return Student(self.clients[-1])

    def joined(self, **wanted: Any) -> "Student":
        """Return a browser that has joined."""
        student = self.student()
        answer = student.join(**wanted)
        assert answer.status_code == 200, answer.text
        return student

    def state(self) -> dict[str, Any]:
        """Return what the teacher's page shows."""
        answer = http_client.get(f"{self.url}teacher/state", headers=self._auth())
        assert answer.status_code == 200, answer.text
        found: dict[str, Any] = answer.json()
        return found

    def networks(self, room: str) -> list[dict[str, Any]]:
        """Return the networks that learned in a room, as the teacher's page lists them."""
        url = f"{self.url}teacher/networks?room={room}"
        answer = http_client.get(url, headers=self._auth())
        return list(answer.json()["networks"])

    def command(self, do: str, **rest: Any) -> httpx.Response:
        """Send a teacher's command."""
        body = {"do": do, **rest}
        return http_client.post(f"{self.url}teacher/command", json=body, headers=self._auth())

    def export(self) -> bytes:
        """Return the ZIP file with the work of the class."""
        answer = http_client.get(f"{self.url}teacher/export", headers=self._auth())
        assert answer.status_code == 200, answer.text
        return answer.content

    def _auth(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.token}"}


@dataclass
class Student:
    """A browser, with its cookies."""

    client: httpx.Client
    room: str = ""
    """Path of its room, with a slash at the end."""

    def join(self, code: str = CODE, name: str = "", request: str = "") -> httpx.Response:
        """Ask for a seat."""
        name = name or self.client.get("api/names").json()["names"][0]
        request = request or f"{next(_requests):016}"
        body = {"code": code, "name": name, "request": request}
        answer = self.client.post("api/join", json=body)
        self.room = answer.json().get("room", self.room)
        return answer

    def get(self, path: str) -> httpx.Response:
        """Return the room's answer to a request."""
        return self.client.get(self.room + path)

    @property
    def cookies(self) -> dict[str, str]:
        """The headers with this browser's cookies, for a socket."""
        pairs = "; ".join(f"{name}={value}" for name, value in self.client.cookies.items())
        return {"Cookie": pairs}

    @property
    def token(self) -> str:
        """The secret of its seat; each class has a name of its own for the cookie."""
        cookies = self.client.cookies.items()
        return next(value for name, value in cookies if name.startswith(SEAT_COOKIE))

    @property
    def address(self) -> str:
        """The address of its room's page."""
        return str(self.client.base_url).rstrip("/") + self.room


def environment() -> dict[str, str]:
    """Return the variables of a process that imports the tests."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}


@contextlib.contextmanager
def served_class(
    folder: Path, *options: str, replaced: Mapping[str, float] | None = None
) -> Iterator[ServedClass]:
    """Serve a class until the end, with the code that tests use.

    Args:
        folder: of the class.
        options: more of the command's.
        replaced: numbers for constants in its process, such as ``{"ai4u_edu.module.NAME": 1}``.
    """
    command = [sys.executable, "-m", MODULE]
    for name, number in (replaced or {}).items():
        command += [OPTION, f"{name}={number}"]
    command += ["--folder", str(folder), "--no-open"]
    command += ["--host", "127.0.0.1", "--port", "0", "--code", CODE, *options]
    told: list[str] = []
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        bufsize=1,
        env=environment(),
    ) as process:
        assert process.stdout is not None
        address = ""
        for line in process.stdout:
            told.append(line)
            found = re.search(r"(http://\S+/)teacher(\?\S+)", line)
            if found:
                address = found[0]
                break
        assert address, "".join(told)
        listener = threading.Thread(target=lambda: told.extend(process.stdout or ()))
        listener.start()
        parts = urlsplit(address)
        token = parse_qs(parts.query)["token"][0]
        served = ServedClass(process, f"http://{parts.netloc}/", token, folder, told)
        try:
            yield served
        finally:
            for client in served.clients:
                client.close()
            process.terminate()
            listener.join(LIMIT_S)
