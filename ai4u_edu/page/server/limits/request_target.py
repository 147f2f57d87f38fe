"""Targets of requests: each server takes paths alone, and a proxy sends on the one it decided on.

The target of a request is text from outside. Put behind the address of another server, one that
does not begin with a slash changes that address: with ``@10.0.0.5/x`` everything before the sign
becomes a user's name. And one that is not normalized may be another path for the next server.
"""

from urllib.parse import quote, quote_from_bytes

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

NO_PATH = (
    "expected a request for a path, which begins with a slash, got another target; this server is "
    "no proxy\n"
)
_QUERY_SAFE = "!$%&'()*+,-./:;=?@[]_~"
"""Characters that stay in a query: all that it may have (RFC 3986, 3.4), and brackets."""


class PathsOnly:
    """ASGI middleware that answers a request for anything but a path with 400.

    Args:
        app: gets all other requests.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] in ("http", "websocket") and not _is_path(scope):
            headers = {"Connection": "close"} if scope["type"] == "http" else None
            await PlainTextResponse(NO_PATH, 400, headers)(scope, receive, send)
            return
        await self._app(scope, receive, send)


def target_of(scope: Scope) -> str:
    """Return the target for another server: the path in a scope, escaped, and the query.

    The other server reads the same path, however it was escaped in the request.

    >>> target_of({"path": "/r/a1/x y#@b", "query_string": b"q=%41#"})
    '/r/a1/x%20y%23%40b?q=%41%23'
    """
    query = quote_from_bytes(scope["query_string"], safe=_QUERY_SAFE)
    return f"{quote(scope['path'])}{'?' * bool(query)}{query}"


def _is_path(scope: Scope) -> bool:
    raw: bytes = scope.get("raw_path") or scope["path"].encode()
    return raw.startswith(b"/")
