"""Addresses of worlds."""

from typing import NamedTuple
from urllib.parse import parse_qs, urlsplit

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.errors import RemoteError

_SCHEMES = {"http": "ws", "https": "wss", "ws": "ws", "wss": "wss"}
_LOOPBACK = {"localhost", "127.0.0.1", "::1"}


class Address(NamedTuple):
    """The address of a world's WebSocket, and the token that was part of the page's address."""

    url: str
    """Address of the WebSocket for scripts."""
    token: str
    is_loopback: bool


def address_of(url: str, token: str = "") -> Address:
    """Return the address of the WebSocket for scripts, made of the page's address.

    Args:
        url: the page's address.
        token: the world's; default: the one in the page's address.

    >>> address_of("http://teacher:8080/?token=abc")
    Address(url='ws://teacher:8080/ws/remote', token='abc', is_loopback=False)
    >>> address_of("teacher:8080/lab").url
    'ws://teacher:8080/lab/ws/remote'

    Raises:
        RemoteError: it is not an address of a page.
    """
    try:
        parts = urlsplit(url if "://" in url else f"http://{url}")
        scheme, host = _SCHEMES.get(parts.scheme), parts.hostname
        _port = parts.port
    except ValueError:
        scheme, host = None, None
    if scheme is None or not host:
        raise RemoteError(
            _("expected the page's address, such as 'http://127.0.0.1:8080', got {url!r}", url=url)
        )
    token = token or parse_qs(parts.query).get("token", [""])[0]
    path = parts.path.rstrip("/").removesuffix("/ws/remote")
    return Address(f"{scheme}://{parts.netloc}{path}/ws/remote", token, host in _LOOPBACK)
