"""Sign-in of browsers by the hub's OAuth (RFC 6749, authorization code with RFC 7636).

The hub's groups give access to the teacher's pages, in the place of a secret address.
"""

import base64
import hashlib
import json
import secrets
from collections.abc import Collection
from typing import Any
from urllib.parse import urlencode

from starlette.requests import HTTPConnection, Request
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.hub.api import HubApi, HubUnreachableError, HubUser, NoAccessError
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.join import NO_STORE
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.limits.socket_close import NOT_ALLOWED, TRY_LATER, refuse_socket
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.page.server.token_auth import is_same_secret
from ai4u_edu.page.server.token_page import wants_page

COOKIE = "ai4u-edu-hub"
"""Cookie with the browser's token of the hub; scripts in a page can't read it."""
STATE_COOKIE = "ai4u-edu-hub-state"
SIGN_IN = _("expected somebody who has signed in at the hub; open the class's page")
STATE_LIFE_S = 600
TOKEN_LIFE_S = 14 * 24 * 3600
PAGES = ("", "teacher", "projector")
"""Pages to which a browser goes after the sign-in."""


class SignIn:
    """Finds out whose browser sends a request, and sends browsers to the hub to sign in.

    Args:
        hub: environment of the service.
        api: of the hub.
    """

    def __init__(self, hub: HubEnvironment, api: HubApi) -> None:
        self._hub, self._api = hub, api

    async def user_of(self, given: HTTPConnection) -> HubUser | None:
        """Return the user of a browser's cookie; None if it has to sign in.

        Raises:
            HubUnreachableError: the hub does not answer.
            NoAccessError: the user may not use this service.
        """
        token = given.cookies.get(COOKIE, "")
        return await self._api.user_of(token, client_address(given.scope)) if token else None

    def begin(self, request: HTTPConnection) -> Response:
        """Return the redirect with which a browser begins to sign in."""
        page = request.url.path.removeprefix("/")
        state, verifier = secrets.token_urlsafe(24), secrets.token_urlsafe(32)
        query = {
            "client_id": self._hub.client_id,
            "redirect_uri": self._hub.redirect_uri,
            "response_type": "code",
            "state": state,
            "code_challenge": _challenge_of(verifier),
            "code_challenge_method": "S256",
        }
        address = f"{self._hub.hub_url}api/oauth2/authorize?{urlencode(query)}"
        response = RedirectResponse(address, 302, NO_STORE)
        kept = {"state": state, "verifier": verifier, "page": page if page in PAGES else ""}
        value = base64.urlsafe_b64encode(json.dumps(kept).encode()).decode()
        self._set(response, request, STATE_COOKIE, value, STATE_LIFE_S)
        return response

    async def callback(self, request: Request) -> Response:
        """Return the redirect to the page, with the cookie of a browser that has signed in."""
        kept = _read_state(request.cookies.get(STATE_COOKIE, ""))
        given = request.query_params
        if kept is None or not is_same_secret(kept["state"], given.get("state", "")):
            text = _(
                "This sign-in was begun in another window, or too long ago. Open the class again: "
                "{prefix}",
                prefix=self._hub.prefix,
            )
            return TextResponse(text, 403, NO_STORE)
        if not given.get("code"):
            why = given.get("error_description") or given.get("error") or _("it gave no reason")
            return TextResponse(
                _("The hub did not sign you in: {why}", why=why[:200]), 403, NO_STORE
            )
        try:
            token = await self._api.token_for(given["code"], kept["verifier"])
            address = client_address(request.scope)
            user = await self._api.user_of(token, address) if token else None
        except HubUnreachableError as error:
            return TextResponse(text_of(error), 503, NO_STORE)
        except NoAccessError as error:
            return TextResponse(text_of(error), 403, NO_STORE)
        if user is None:
            text = _(
                "The hub does not know this sign-in. Open the class again: {prefix}",
                prefix=self._hub.prefix,
            )
            return TextResponse(text, 403, NO_STORE)
        response = RedirectResponse(f"{self._hub.prefix}{kept['page']}", 303, NO_STORE)
        self._set(response, request, COOKIE, token, TOKEN_LIFE_S)
        response.delete_cookie(STATE_COOKIE, path=self._hub.prefix)
        return response

    def _set(
        self, response: Response, request: HTTPConnection, name: str, value: str, life_s: int
    ) -> None:
        response.set_cookie(
            name,
            value,
            max_age=life_s,
            path=self._hub.prefix,  # so students' servers at the same host don't get it
            secure=request.url.scheme == "https",
            httponly=True,
            samesite="lax",
        )


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
            await _refuse(text_of(error), 503, scope, receive, send)
            return
        except NoAccessError as error:
            await _refuse(text_of(error), 403, scope, receive, send)
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
            text = _(
                "This page is for teachers: admins of the hub, and its group {groups}.",
                groups=groups,
            )
            await _refuse(text, 403, scope, receive, send)


def _challenge_of(verifier: str) -> str:
    digest = hashlib.sha256(verifier.encode()).digest()
    return base64.urlsafe_b64encode(digest).decode().rstrip("=")


def _read_state(cookie: str) -> dict[str, str] | None:
    """Return what :meth:`SignIn.begin` kept in the browser; None if that is not there."""
    try:
        kept: Any = json.loads(base64.urlsafe_b64decode(cookie))
    except ValueError:
        return None
    is_fine = isinstance(kept, dict) and kept.keys() == {"state", "verifier", "page"}
    is_fine = is_fine and all(isinstance(each, str) for each in kept.values())
    return kept if is_fine and kept["page"] in PAGES else None


async def _refuse(text: str, status: int, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        code = TRY_LATER if status == 503 else NOT_ALLOWED
        await refuse_socket(scope, receive, send, code, text)
        return
    response: Response = TextResponse(text, status, NO_STORE)
    await response(scope, receive, send)
