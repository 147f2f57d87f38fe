"""A class without rooms: the pages of the teacher, with messages that a test sends."""

import asyncio
import contextlib
import json
from collections.abc import Iterator
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from ai4u_edu.classroom.pages import FILE_ROUTES, Echo
from ai4u_edu.page.server import ServerThread
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit
from ai4u_edu.page.server.reader_language import ReaderLanguage
from ai4u_edu.page.server.standalone import standalone_page
from tests.browser.wall_data import class_message, drawing_message, poses_message
from tests.waiting import LIMIT_S

POSES_PER_S = 4


class WallServer:
    """Serves the pages at ``url``, and tells what they sent in ``commands``."""

    def __init__(self, count: int) -> None:
        """
        Args:
            count: number of rooms.
        """
        self.url = ""
        self.count = count
        self.moves = True
        """Poses go on with time."""
        self.connections = 0
        """Number of sockets that have got the class's state so far."""
        self._sockets: set[WebSocket] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self.reset()

    def reset(self) -> None:
        """Begin again with the state of a class in which nothing has happened yet."""
        self.commands: list[dict[str, Any]] = []
        self.paths: list[str] = []
        """Paths with query of all requests."""
        self.bodies: list[bytes] = []
        self.problem = ""
        """Answer to commands with this sentence, if there is one."""
        self.answer: dict[str, Any] = {"room": "/privacy"}
        self.programs: list[dict[str, Any]] = []
        """Programs of any room."""
        self.state = class_message(self.count)
        """Message that a page gets when it connects, and after :meth:`send`."""

    def app(self) -> Starlette:
        """Return the pages, the sockets and the commands."""
        names = ("teacher", "projector", "check", "privacy", "join")
        return Starlette(
            routes=[
                *(Route(f"/{each}", self._page) for each in names),
                Route("/teacher/command", self._command, methods=["POST"]),
                Route("/teacher/programs", self._programs),
                Route("/api/names", self._names),
                Route("/api/join", self._command, methods=["POST"]),
                WebSocketRoute("/check/socket", Echo(ConcurrencyLimit(50, 0.2))),
                WebSocketRoute("/{page}/socket", self._socket),
                *FILE_ROUTES,
            ],
            middleware=[Middleware(ReaderLanguage)],
        )

    def send(self, **changes: Any) -> None:
        """Change the class's state, and send it to all pages."""
        self.state = {**self.state, **changes}
        self.push(self.state)

    def push(self, message: dict[str, Any]) -> None:
        """Send a message to all pages."""
        if self._loop is None:  # no page has connected yet
            return
        asyncio.run_coroutine_threadsafe(self._broadcast(message), self._loop).result(LIMIT_S)

    def draw(self) -> None:
        """Send all drawings to all pages, which forget those of rooms that are gone."""
        for number in range(1, self.count + 1):
            self.push(drawing_message(number))

    def drop(self) -> None:
        """Close all sockets."""
        assert self._loop is not None
        for socket in list(self._sockets):
            asyncio.run_coroutine_threadsafe(socket.close(1001), self._loop).result(LIMIT_S)

    async def _broadcast(self, message: dict[str, Any]) -> None:
        for socket in list(self._sockets):
            with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # the page has left
                await socket.send_text(json.dumps(message))

    async def _page(self, request: Request) -> Response:
        self.paths.append(str(request.url))
        return standalone_page(f"{request.url.path.strip('/')}.html")

    async def _command(self, request: Request) -> Response:
        body = await request.body()
        self.bodies.append(body)
        self.commands.append(json.loads(body))
        if self.problem:
            return JSONResponse({"problem": self.problem}, 400)
        return JSONResponse(self.answer)

    async def _programs(self, request: Request) -> Response:
        self.paths.append(str(request.url))
        if self.problem:
            return JSONResponse({"problem": self.problem}, 503)
        return JSONResponse({"programs": self.programs})

    async def _names(self, _: Request) -> Response:
        return JSONResponse({"names": ["Red Fox", "Calm Owl", "Swift Crab"]})

    async def _socket(self, socket: WebSocket) -> None:
        self._loop = asyncio.get_running_loop()
        await socket.accept()
        self._sockets.add(socket)  # before the state is read, so that no change of it is missed
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            await socket.send_text(json.dumps(self.state))
            self.connections += 1
            for number in range(1, self.count + 1):
                await socket.send_text(json.dumps(drawing_message(number)))
            step = 0
            while socket in self._sockets:
                await socket.send_text(json.dumps(poses_message(self.count, step / POSES_PER_S)))
                step += self.moves
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(socket.receive_text(), 1 / POSES_PER_S)
        self._sockets.discard(socket)


@contextlib.contextmanager
def wall_server(count: int) -> Iterator[WallServer]:
    """Serve a class with a number of rooms."""
    served = WallServer(count)
    with ServerThread(served.app()) as server:
        served.url = server.url
        yield served
