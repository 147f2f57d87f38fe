"""Malformed requests to the page's server, in the process."""

import asyncio
import json
import random
from functools import cache
from typing import Any
from urllib.parse import unquote

from starlette.applications import Starlette

from ai4u_edu.page.server import room_app
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim
from tests.fuzz.mutate import mangled
from tests.fuzz.target import MANY, Target

METHODS = (b"GET", b"GET", b"GET", b"HEAD", b"POST", b"PUT", b"OPTIONS", b"TRACE", b"get", b"")
PATHS = (
    b"/", b"/healthz", b"/api/snapshot", b"/api/openapi.json", b"/web/page/main.js",
    b"/web/styles/page/page.css",
    b"/web/../pyproject.toml", b"/web/..%2f..%2fREADME.md", b"/web/%00", b"//", b"/ws/remote",
    b"/ws/input", b"/api/", b"/api/past", b"/api/past/x.episode", b"/api/past/..%2f..%2fetc",
    b"/web/.", b"/web/" + b"a" * 5000, b"*", b"http://evil.example/healthz",
)  # fmt: skip
HOSTS = (
    b"localhost", b"localhost:8080", b"127.0.0.1", b"[::1]:80", b"evil.example", b"localhost@evil",
    b"LOCALHOST", b"localhost:99999", b"", b"[::1", b"127.1", b"localhost\x00", b"\xff", b"[" * 50,
)  # fmt: skip
NAMES = (
    b"origin", b"if-none-match", b"range", b"cookie", b"host", b"accept", b"connection", b"upgrade",
    b"if-modified-since", b"content-length", b"x-forwarded-host", b"authorization", b"if-range",
)  # fmt: skip
VALUES = (
    b"*", b"bytes=0-", b"bytes=5-1,9-", b"bytes=-99999999999999999999", b"\xff\xfe", b"a" * 3000,
    b"http://localhost", b"http://evil.example", b"null", b"Sat, 99 Foo 2026 00:00:00 GMT", b"W/\"",
    b"bytes=0-0,-1", b"token=x; token=y", b"",
)  # fmt: skip


@cache
def _room() -> Starlette:
    return room_app(Runner(small_sim(), seed=1), viser_port=9, title="<b>A room</b> & more")


@cache
def loop() -> asyncio.AbstractEventLoop:
    """Return the server that all requests share, in this thread."""
    return asyncio.new_event_loop()


def make_request(rng: random.Random) -> bytes:
    """Return a request: its first line, a line for each header, its body."""
    path = rng.choice(PATHS)
    if rng.random() < 0.3:
        path = mangled(path, rng, PATHS)
    if rng.random() < 0.3:
        path += b"?" + rng.choice((b"agent=0", b"token=%ff", b"&&=", rng.randbytes(9)))
    host = HOSTS[0] if rng.random() < 0.6 else rng.choice(HOSTS)
    lines = [rng.choice(METHODS) + b" " + path]
    lines += [b"host: " + host] if rng.random() < 0.95 else []
    for _ in range(rng.choice((0, 0, 1, 2, 5))):
        lines.append(rng.choice(NAMES) + b": " + rng.choice(VALUES))
    body = rng.choice((b"", b"", b"{}", b"\x00" * 100))
    return b"\n".join(line.replace(b"\n", b"") for line in lines) + b"\n\n" + body


def ask(data: bytes) -> tuple[int, bytes]:
    """Return status and body of the answer."""
    return loop().run_until_complete(_answer(data))


def read_request(data: bytes) -> None:
    """Send a request; check that the answer is valid HTTP, and JSON if it claims to be."""
    status, body = ask(data)
    assert 200 <= status < 500, status
    if status == 200 and b" /api/snapshot" in data[:20] and data.startswith(b"GET"):
        json.loads(body)


async def _answer(data: bytes) -> tuple[int, bytes]:
    head, _, body = data.partition(b"\n\n")
    first, *lines = head.split(b"\n")
    method, _, target = first.partition(b" ")
    target = bytes(byte for byte in target if 32 < byte < 127)  # uvicorn lets no others through
    path, _, query = target.partition(b"?")
    headers = [line.partition(b": ")[::2] for line in lines]
    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method.decode("latin-1"),
        "scheme": "http",
        "path": unquote(path.decode()),
        "raw_path": path,
        "query_string": query,
        "root_path": "",
        "headers": headers,
        "client": ("127.0.0.1", 1),
        "server": ("127.0.0.1", 80),
    }
    sent: list[Any] = []

    asked = 0

    async def receive() -> dict[str, Any]:
        nonlocal asked
        asked += 1
        if asked > 1:  # the client stays, and says no more
            await asyncio.Event().wait()
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(message: Any) -> None:
        sent.append(message)

    await _room()(scope, receive, send)
    answer = b"".join(message.get("body", b"") for message in sent[1:])
    return int(sent[0]["status"]), answer


REQUESTS = Target("http", make_request, read_request, (), count=MANY)
