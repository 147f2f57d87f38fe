"""Who may come in: browsers on our own page, and programs that are no browsers.

Two things are looked at. The name under which we were asked for (``Host``): a foreign page that
has its own name point at this machine still sends its own name. And, where a WebSocket is opened,
the page that opens it (``Origin``): browsers let any page open one to anywhere.
"""

import ipaddress
import re
import socket
from collections.abc import Collection

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOOPBACK = ("localhost", "127.0.0.1", "[::1]")
"""The names of this machine, for itself."""
ADDRESSES = "<any address>"
"""Among the allowed hosts: every IP address. No page can have one of those as its own name."""

_HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9._-]+)(:\d{1,5})?")


def hosts_for(bound: str) -> tuple[str, ...]:
    """The names to allow when listening at an address.

    >>> hosts_for("127.0.0.1")
    ('localhost', '127.0.0.1', '[::1]')
    >>> ADDRESSES in hosts_for("0.0.0.0")
    True
    """
    shown = (f"[{bound}]" if ":" in bound else bound).lower()
    if is_loopback(bound):
        return LOOPBACK if shown in LOOPBACK else (*LOOPBACK, shown)
    name = socket.gethostname().lower()
    return (*LOOPBACK, ADDRESSES, name, f"{name}.local", shown)


def is_loopback(bound: str) -> bool:
    """Whether only this machine reaches who listens at an address.

    >>> is_loopback("localhost"), is_loopback("127.0.0.2"), is_loopback("0.0.0.0")
    (True, True, False)
    """
    try:
        found = {str(each[4][0]) for each in socket.getaddrinfo(bound, None)}
    except (OSError, UnicodeError):  # then there is no listening there, and that is told
        return False
    return all(ipaddress.ip_address(each.partition("%")[0]).is_loopback for each in found)


class Door:
    """Turns away whoever should not come in; an ASGI middleware.

    Args:
        app: what is behind the door.
        allowed_hosts: names (without port) under which we may be asked for, :data:`ADDRESSES`, or
            ``"*"`` for any. A page of a name listed here, other than those in :data:`LOOPBACK`,
            may open WebSockets even where a proxy in front has changed the ``Host``.
    """

    def __init__(self, app: ASGIApp, allowed_hosts: Collection[str] = LOOPBACK) -> None:
        self._app = app
        self._hosts = {name.lower() for name in allowed_hosts}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Lets a request in, or answers it with 403 and the reason."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self.refusal(Headers(scope=scope), websocket=scope["type"] == "websocket")
        if refusal:
            await PlainTextResponse(refusal + "\n", 403)(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["X-Content-Type-Options"] = "nosniff"
                headers["Cross-Origin-Resource-Policy"] = "same-origin"
                headers["Referrer-Policy"] = "no-referrer"
            await send(message)

        await self._app(scope, receive, send_guarded)

    def refusal(self, headers: Headers, *, websocket: bool) -> str:
        """Why a request is turned away; empty if it is not.

        >>> door = Door(lambda *_: None)
        >>> door.refusal(Headers({"host": "localhost:8080"}), websocket=False)
        ''
        >>> door.refusal(Headers({"host": "evil.example"}), websocket=False)
        "Host: expected one of 127.0.0.1, [::1], localhost, got 'evil.example'; a name is allowed \
with --allow-host NAME"
        """
        hosts = headers.getlist("host")
        host = hosts[0].lower() if len(hosts) == 1 else ""
        parts = _HOST.fullmatch(host)
        if parts is None or not self._knows(parts[1]):
            return (
                f"Host: expected one of {', '.join(sorted(self._hosts))}, got {', '.join(hosts)!r};"
                " a name is allowed with --allow-host NAME"
            )
        origins = headers.getlist("origin") if websocket else []
        if not all(self._is_ours(origin.lower(), host) for origin in origins):
            return (
                f"Origin: expected http://{host} (the page that this server gives out), got "
                f"{', '.join(origins)!r}; behind a proxy, start with --allow-host NAME"
            )
        return ""

    def _knows(self, name: str) -> bool:
        if "*" in self._hosts or name in self._hosts:
            return True
        if ADDRESSES not in self._hosts:
            return False
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return True

    def _is_ours(self, origin: str, host: str) -> bool:
        scheme, _, place = origin.partition("://")
        parts = _HOST.fullmatch(place)
        if scheme not in ("http", "https") or parts is None:
            return False
        if _short(place) == _short(host):
            return True
        return parts[1] in self._hosts and parts[1] not in LOOPBACK


def _short(place: str) -> str:
    return place.removesuffix(":80").removesuffix(":443")
