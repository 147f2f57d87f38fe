"""What a script's connection may find at its other end."""

import queue
import shutil
import socket
import ssl
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request
from websockets.server import ServerProtocol
from websockets.sync.client import connect
from websockets.sync.server import ServerConnection, serve

from ai4u_edu.remote.direct_socket import DirectSocket

SOON = 5.0
"""Seconds in which whatever happens at once has happened."""


def opened(url: str, **options: Any) -> DirectSocket:
    """A connection."""
    defaults = {"proxy": None, "compression": None, "create_connection": DirectSocket}
    quick = {"ping_interval": 0.1, "ping_timeout": SOON, "close_timeout": 0.5}
    found: Any = connect(url, **(defaults | quick | options))
    assert isinstance(found, DirectSocket)
    return found


def echo(far: ServerConnection) -> None:
    """Says what it hears."""
    for message in far:
        far.send(message)


@contextmanager
def serving(handler: Callable[[ServerConnection], None], **options: Any) -> Iterator[str]:
    """A server of websockets' own; its address."""
    options = {"compression": None, "close_timeout": 0.5} | options
    with serve(handler, "127.0.0.1", 0, **options) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        scheme = "wss" if "ssl" in options else "ws"
        try:
            yield f"{scheme}://localhost:{server.socket.getsockname()[1]}"
        finally:
            server.shutdown()
            thread.join()


@contextmanager
def facing(handler: Callable[[ServerConnection], None], **options: Any) -> Iterator[DirectSocket]:
    """A connection to a server of websockets' own."""
    with serving(handler) as url, closing(opened(url, **options)) as near:
        yield near


@contextmanager
def facing_bare(**options: Any) -> Iterator[tuple[DirectSocket, socket.socket]]:
    """A connection, and its other end, that does nothing by itself after the handshake."""
    ends: queue.Queue[socket.socket] = queue.Queue()
    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=lambda: ends.put(_accepted(listener)))
        thread.start()
        try:
            url = f"ws://127.0.0.1:{listener.getsockname()[1]}"
            with closing(opened(url, **options)) as near, ends.get(timeout=SOON) as far:
                far.settimeout(SOON)
                yield near, far
        finally:
            thread.join()


def _accepted(listener: socket.socket) -> socket.socket:
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2**12)
    far, _ = listener.accept()
    protocol = ServerProtocol()
    while not (events := protocol.events_received()):
        protocol.receive_data(far.recv(2**12))
    assert isinstance(events[0], Request)
    protocol.send_response(protocol.accept(events[0]))
    far.sendall(b"".join(protocol.data_to_send()))
    return far


def ending(call: Callable[[], object]) -> ConnectionClosed:
    """How a connection is found to be closed, by what is tried until then."""
    while True:
        try:
            call()
        except ConnectionClosed as closed:
            return closed


def certificate(folder: Path) -> tuple[ssl.SSLContext, ssl.SSLContext]:
    """What a server shows, and a client that believes it."""
    openssl = shutil.which("openssl")
    if openssl is None:
        pytest.skip("expected openssl, to make a certificate")
    key, shown = folder / "key.pem", folder / "shown.pem"
    wanted = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=ours"]
    names = ["-addext", "subjectAltName=DNS:localhost", "-keyout", str(key), "-out", str(shown)]
    subprocess.run([openssl, *wanted, *names], check=True, capture_output=True)
    server = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    server.load_cert_chain(shown, key)
    return server, ssl.create_default_context(cafile=str(shown))
