"""The pages of a class that are not a room's: files of ``web/``, and the socket of one of them."""

import contextlib
from collections.abc import Awaitable, Callable
from functools import lru_cache

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.page.server.library_pictures import PICTURE_PATH, library_picture_route
from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit
from ai4u_edu.page.server.standalone import standalone_page
from ai4u_edu.page.server.web_files import WEB_PATHS, WebFiles

MAX_ECHOES = 20
MAX_ECHO_CHARS = 100


async def _web_file(request: Request) -> Response:
    """Return a script or a style."""
    return _web_files().response(request, request.path_params["file"])


FILE_ROUTES = [
    *[Route(path + "/{file}", _web_file) for path in WEB_PATHS],
    Route(PICTURE_PATH, library_picture_route),
]
"""Routes of the files that these pages load; everybody may have them."""


def page_route(name: str) -> Callable[[Request], Awaitable[Response]]:
    """Return a route's function that answers with a page of ``web/``."""

    async def answer(_: Request) -> Response:
        return standalone_page(name)

    return answer


@lru_cache(maxsize=1)
def _web_files() -> WebFiles:
    return WebFiles()


class Echo:
    """Socket of the page that checks a device, which anybody may open.

    It sends each text back, up to a number of them, and closes on anything else.

    Args:
        strangers: limit of the sockets that anybody may open, by address.
    """

    def __init__(self, strangers: ConcurrencyLimit) -> None:
        self._strangers = strangers

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one socket."""
        await self._strangers.serve(client_address(scope), _echo, scope, receive, send)


async def _echo(scope: Scope, receive: Receive, send: Send) -> None:
    socket = WebSocket(scope, receive, send)
    await socket.accept()
    with contextlib.suppress(WebSocketDisconnect, KeyError):  # the latter for bytes
        for _ in range(MAX_ECHOES):
            text = await socket.receive_text()
            if len(text) > MAX_ECHO_CHARS:
                break
            await socket.send_text(text)
    if socket.client_state is WebSocketState.CONNECTED:
        await socket.close()
