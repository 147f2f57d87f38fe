"""Requests as bytes, as no client sends them: clients normalize a target before they send it."""

import re
import socket
import threading
from collections.abc import Mapping
from contextlib import suppress
from types import TracebackType
from typing import Self
from urllib.parse import urlsplit

from tests.waiting import LIMIT_S

MAX_ANSWER_BYTES = 2**16
SWITCHING = b"HTTP/1.1 101"


class ForbiddenServer:
    """A listening server that must never be reached; it counts who comes, and answers.

    Use it in a ``with``.
    """

    def __init__(self) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        self.requests: list[bytes] = []
        """First bytes of each connection."""
        self._thread = threading.Thread(target=self._serve, name="forbidden", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self._thread.join(LIMIT_S)

    def _serve(self) -> None:
        with suppress(OSError):
            while True:
                connection, _ = self._listener.accept()
                with connection, suppress(OSError):
                    connection.settimeout(LIMIT_S)
                    self.requests.append(connection.recv(MAX_ANSWER_BYTES))
                    connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 7\r\n\r\nreached")


def ask(
    url: str,
    target: bytes,
    headers: Mapping[str, str] | None = None,
    method: bytes = b"GET",
    body: bytes = b"",
) -> bytes:
    """Send a request as it is, and return the answer; of an accepted WebSocket its head alone.

    Args:
        url: of the server.
        target: second word of the request.
        headers: more of them than ``Host`` and ``Connection``.
        method: of the request.
        body: of the request.
    """
    parts = urlsplit(url)
    sent = {"Host": parts.netloc, "Connection": "close", **(headers or {})}
    if body:
        sent["Content-Length"] = str(len(body))
    lines = [f"{name}: {value}".encode("latin-1") for name, value in sent.items()]
    head = b"\r\n".join([method + b" " + target + b" HTTP/1.1", *lines, b"", b""])
    answer = b""
    with (
        socket.create_connection((parts.hostname, parts.port or 80), LIMIT_S) as connection,
        suppress(ConnectionError),  # refused before everything was sent or read
    ):
        connection.sendall(head + body)
        while part := connection.recv(4096):
            answer += part
            if _is_whole(answer, method) or len(answer) > MAX_ANSWER_BYTES:
                break
    return answer


def _is_whole(answer: bytes, method: bytes) -> bool:
    """Return True if an answer is complete, though its connection may be kept."""
    head, end, body = answer.partition(b"\r\n\r\n")
    if not end:
        return False
    if method == b"HEAD" or head.startswith((SWITCHING, b"HTTP/1.1 204", b"HTTP/1.1 304")):
        return True
    length = re.search(rb"(?i)\r\ncontent-length: *(\d+)", head)
    return len(body) >= int(length[1]) if length else body.endswith(b"0\r\n\r\n")


def status_of(answer: bytes) -> int:
    """Return the status of an answer; 0 if the connection was closed without one."""
    words = answer.split(b" ", 2)
    return int(words[1]) if len(words) > 1 and words[1].isdigit() else 0


SOCKET_HEADERS = {
    "Connection": "Upgrade",
    "Upgrade": "websocket",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
}
"""Headers of a request for a WebSocket."""
