"""Addresses of brains on the command line."""

from typing import Any
from urllib.parse import parse_qsl, urlsplit

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.remote import RemoteBrain

EXAMPLE = "ai4u://127.0.0.1:8080"


def brain_at(address: str) -> RemoteBrain:
    """Return the brain at an address; its parameters may follow a question mark.

    >>> brain_at("ai4u://127.0.0.1:8090?mode=realtime&on_missing=stop")
    RemoteBrain(port=8090, mode='realtime', on_missing='stop')
    >>> brain_at("http://127.0.0.1:8090")
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SetupError: brain: expected an address such as ai4u://127.0.0.1:8080, got \
'http://127.0.0.1:8090'
    """
    try:
        parts = urlsplit(address)
        port = parts.port
    except ValueError:
        parts, port = urlsplit(""), None
    if parts.scheme != "ai4u" or not parts.hostname or parts.path not in ("", "/"):
        raise SetupError(f"brain: expected an address such as {EXAMPLE}, got {address!r}")
    place: dict[str, Any] = {"host": parts.hostname, "port": 8080 if port is None else port}
    return RemoteBrain(**(place | dict(parse_qsl(parts.query))))
