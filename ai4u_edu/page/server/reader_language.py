"""The language of each page: the middleware that chooses it, and responses of one sentence."""

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu.locale import language_of_page, reader, translate


class ReaderLanguage:
    """Translates what a request or socket is answered with into its browser's language.

    Args:
        app: the app that answers.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request or a socket."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        with reader(language_of_page(Headers(scope=scope).get("accept-language", ""))):
            await self._app(scope, receive, send)


class TextResponse(PlainTextResponse):
    """Plain text of one line, in the reader's language."""

    def render(self, content: str) -> bytes:
        """Return the line."""
        return f"{translate(content)}\n".encode()
