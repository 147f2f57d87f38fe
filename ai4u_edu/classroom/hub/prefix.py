"""Path and scheme of requests that come through the hub's proxy."""

from urllib.parse import quote

from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

FORWARDED_PROTO = b"x-forwarded-proto"
_SECURE = {"http": "https", "ws": "wss"}


class BehindHub:
    """ASGI middleware that removes the service's prefix, which the hub's proxy leaves in paths.

    It also takes over the scheme that the browser uses. A client can forge that header for its own
    requests only, where it has no use.

    Args:
        app: the app, which has no prefix.
        prefix: such as ``/services/ai4u-class/``.
    """

    def __init__(self, app: ASGIApp, prefix: str) -> None:
        self._app, self._prefix = app, prefix.rstrip("/")

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on without the prefix."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        path: str = scope["path"]
        if path == self._prefix and scope["type"] == "http":
            await RedirectResponse(f"{self._prefix}/")(scope, receive, send)
        elif path.startswith(f"{self._prefix}/"):
            inner_path = path.removeprefix(self._prefix)
            inner = {
                **scope,
                "path": inner_path,
                "raw_path": quote(inner_path).encode(),  # the one that was sent may be escaped
                "scheme": _scheme(scope),
            }
            await self._app(inner, receive, send)
        elif scope["type"] == "http":
            text = f"expected a path below {self._prefix}/\n"
            await PlainTextResponse(text, 404)(scope, receive, send)
        else:
            await WebSocketClose()(scope, receive, send)


def _scheme(scope: Scope) -> str:
    given = next((value for name, value in scope["headers"] if name == FORWARDED_PROTO), b"")
    is_secure = given.partition(b",")[0].strip().lower() in (b"https", b"wss")
    scheme: str = scope["scheme"]
    return _SECURE.get(scheme, scheme) if is_secure else scheme
