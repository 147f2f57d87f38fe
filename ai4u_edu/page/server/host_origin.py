"""Checks of ``Host`` and ``Origin``, against requests that other sites make in a person's browser.

``Host`` is checked against DNS rebinding: a site that lets its own name resolve to this machine
still sends its own name. ``Origin`` and ``Sec-Fetch-Site`` are checked because browsers let any
page open a WebSocket to anywhere, and load our answers as images or scripts. Another port of the
same machine is another site.

Other sites may lead a person to the page: by a link, or in a frame, as notebooks do. Programs that
are no browsers send none of these headers but ``Host``.
"""

import ipaddress
import re
import socket
from collections.abc import Collection

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.reader_language import TextResponse

LOOPBACK = ("localhost", "127.0.0.1", "[::1]")
"""Names of this machine for itself."""
ANY_ADDRESS = "<any address>"
"""Allowed host that stands for every IP address; DNS rebinding needs a name."""

MAX_SHOWN_CHARS = 200
"""Length at which a refusal cuts the header that it repeats."""

_PORTS = {"http": 80, "https": 443}
_OWN_SITES = {"same-origin", "none"}  # "none": typed in, or opened from a bookmark
PAGES = re.compile(r"/?|/start")
"""Paths of pages, to which other sites may lead a person."""
_NAVIGATION_DESTS = {"document", "iframe", "frame"}
_HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9._-]+)(:\d{1,5})?")


def hosts_for(bound: str) -> tuple[str, ...]:
    """Return the host names to allow when listening at an address.

    >>> hosts_for("127.0.0.1")
    ('localhost', '127.0.0.1', '[::1]')
    >>> ANY_ADDRESS in hosts_for("0.0.0.0")
    True
    """
    shown = (f"[{bound}]" if ":" in bound else bound).lower()
    if is_loopback(bound):
        return LOOPBACK if shown in LOOPBACK else (*LOOPBACK, shown)
    name = socket.gethostname().lower()
    return (*LOOPBACK, ANY_ADDRESS, name, f"{name}.local", shown)


def is_loopback(bound: str) -> bool:
    """Return True if only this machine can reach a server at an address.

    >>> is_loopback("localhost"), is_loopback("127.0.0.2"), is_loopback("0.0.0.0")
    (True, True, False)
    """
    try:
        found = {str(each[4][0]) for each in socket.getaddrinfo(bound, None)}
    except (OSError, UnicodeError):  # the server can't listen there, and says so
        return False
    return all(ipaddress.ip_address(each.partition("%")[0]).is_loopback for each in found)


class HostOriginCheck:
    """ASGI middleware that refuses requests for other hosts and from other sites.

    Args:
        app: the protected app.
        allowed_hosts: host names (without port) that requests may use, :data:`ANY_ADDRESS`, or
            ``"*"`` for any.
        proxy_hosts: more such names, of a reverse proxy in front. It may have changed ``Host`` and
            terminated TLS: so pages with these names count as ours, with any port and scheme.
        pages: paths of pages, to which other sites may lead a person.
    """

    def __init__(
        self,
        app: ASGIApp,
        allowed_hosts: Collection[str] = LOOPBACK,
        proxy_hosts: Collection[str] = (),
        pages: re.Pattern[str] = PAGES,
    ) -> None:
        self._app, self._pages = app, pages
        self._proxies = {name.lower() for name in proxy_hosts}
        self._hosts = {name.lower() for name in allowed_hosts} | self._proxies

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or answer it with 403 and the reason."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = self.refusal(scope)
        if refusal:
            await TextResponse(refusal, 403)(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["X-Content-Type-Options"] = "nosniff"
                headers["Cross-Origin-Resource-Policy"] = "same-origin"
                headers["Referrer-Policy"] = "no-referrer"
            await send(message)

        await self._app(scope, receive, send_guarded)

    def refusal(self, scope: Scope) -> str:
        """Return why a request is refused; empty if it is not.

        >>> check = HostOriginCheck(lambda *_: None)
        >>> check.refusal({"type": "http", "headers": [(b"host", b"localhost:8080")]})
        ''
        >>> check.refusal({"type": "http", "headers": [(b"host", b"evil.example")]})
        "Host: expected one of 127.0.0.1, [::1], localhost, got 'evil.example'; a name is allowed \
with --allow-host NAME"
        """
        headers = Headers(scope=scope)
        hosts = headers.getlist("host")
        host = hosts[0].lower() if len(hosts) == 1 else ""
        parts = _HOST.fullmatch(host)
        if parts is None or not _is_sound(parts) or not self._knows(parts[1]):
            return _(
                "Host: expected one of {hosts}, got {got!r}; a name is allowed with "
                "--allow-host NAME",
                hosts=", ".join(sorted(self._hosts)),
                got=_cut(", ".join(hosts)),
            )
        scheme = "https" if scope.get("scheme") in ("https", "wss") else "http"
        origins = headers.getlist("origin")
        if not all(self._is_ours(origin.lower(), host, scheme) for origin in origins):
            return _(
                "Origin: expected {scheme}://{host} (the page that this server gives out), "
                "got {got!r}; behind a proxy, start with --allow-host NAME",
                scheme=scheme,
                host=host,
                got=_cut(", ".join(origins)),
            )
        sites = [site.lower() for site in headers.getlist("sec-fetch-site")]
        if (
            not origins
            and not set(sites) <= _OWN_SITES
            and not _is_navigation(scope, headers, self._pages)
        ):
            return _(
                "Sec-Fetch-Site: expected same-origin (the page that this server gives "
                "out), got {got!r}; open the page itself",
                got=_cut(", ".join(sites)),
            )
        return ""

    def _knows(self, name: str) -> bool:
        if "*" in self._hosts or name in self._hosts:
            return True
        if ANY_ADDRESS not in self._hosts:
            return False
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return True

    def _is_ours(self, origin: str, host: str, scheme: str) -> bool:
        theirs, _colon, place = origin.partition("://")
        parts = _HOST.fullmatch(place)
        if theirs not in _PORTS or parts is None:
            return False
        if parts[1] in self._proxies:
            return True
        if (theirs, _with_port(place, theirs)) == (scheme, _with_port(host, scheme)):
            return True
        # if any name is allowed there is a proxy, which may have terminated TLS and passes Host on
        is_secure = theirs == "https" and "*" in self._hosts
        return is_secure and _with_port(place, theirs) == _with_port(host, theirs)


def _is_sound(parts: re.Match[str]) -> bool:
    """Return True if a port is one, and an address in brackets too; libraries raise at others."""
    name, port = parts[1], parts[2] or ":1"
    try:
        return 0 < int(port[1:]) < 2**16 and (
            name[0] != "[" or bool(ipaddress.ip_address(name[1:-1]))
        )
    except ValueError:
        return False


def _is_navigation(scope: Scope, headers: Headers, pages: re.Pattern[str]) -> bool:
    """Return True for a navigation: another site leads a person to the page."""
    path = scope["path"].removeprefix(scope.get("root_path", ""))
    return (
        scope["type"] == "http"
        and scope["method"] in ("GET", "HEAD")
        and pages.fullmatch(path) is not None
        and headers.get("sec-fetch-mode") == "navigate"
        and headers.get("sec-fetch-dest", "document") in _NAVIGATION_DESTS
    )


def _with_port(place: str, scheme: str) -> str:
    """Return name and port, also where the port is the scheme's own."""
    return place if re.search(r":\d+$", place) else f"{place}:{_PORTS[scheme]}"


def _cut(text: str) -> str:
    return text if len(text) <= MAX_SHOWN_CHARS else f"{text[:MAX_SHOWN_CHARS]}..."
