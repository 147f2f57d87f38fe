"""Access to the teacher's pages by the hub's groups, in the place of a secret address."""

from collections.abc import Collection

from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from ai4u_edu.classroom.hub.api import HubUnreachableError, HubUser, NoAccessError
from ai4u_edu.classroom.hub.sign_in import SignIn
from ai4u_edu.classroom.join import NO_STORE
from ai4u_edu.page.server.token_page import wants_page

NOT_ALLOWED, TRY_LATER = 1008, 1013
SIGN_IN = "expected somebody who has signed in at the hub; open the class's page"


def is_teacher(user: HubUser, groups: Collection[str]) -> bool:
    """Return True for the hub's admins, and for members of a group of teachers."""
    return user.is_admin or bool(user.groups.intersection(groups))


class TeacherAuth:
    """ASGI middleware around one route that lets only teachers pass.

    Args:
        app: the protected app.
        sign_in: knows whose browser it is.
        groups: the hub's groups of teachers.
    """

    def __init__(self, app: ASGIApp, sign_in: SignIn, groups: Collection[str]) -> None:
        self._app, self._sign_in, self._groups = app, sign_in, groups

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it with the reason."""
        given = HTTPConnection(scope)
        try:
            user = await self._sign_in.user_of(given)
        except HubUnreachableError as error:
            await _refuse(str(error), 503, scope, receive, send)
            return
        except NoAccessError as error:
            await _refuse(str(error), 403, scope, receive, send)
            return
        if user is None:
            if scope["type"] == "http" and scope["method"] == "GET" and wants_page(given):
                await self._sign_in.begin(given)(scope, receive, send)
            else:
                await _refuse(SIGN_IN, 401, scope, receive, send)
        elif is_teacher(user, self._groups):
            await self._app(scope, receive, send)
        else:
            groups = ", ".join(self._groups)
            text = f"This page is for teachers: admins of the hub, and its group {groups}."
            await _refuse(text, 403, scope, receive, send)


async def _refuse(text: str, status: int, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        socket = WebSocket(scope, receive, send)
        # a browser tells a script why a socket was closed, but not why a handshake failed
        await socket.accept(next(iter(scope["subprotocols"]), None))
        await socket.close(TRY_LATER if status == 503 else NOT_ALLOWED, text[:100])
        return
    response: Response = PlainTextResponse(f"{text}\n", status, NO_STORE)
    await response(scope, receive, send)
