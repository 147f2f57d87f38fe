"""Token authentication for a room that other machines can reach, as in Jupyter.

The terminal shows an address with the token. A browser that opens it gets a cookie, and is
redirected to the address without the token; without a token it gets a page with a box for it.
Programs send the token with each request, in the address or as ``Authorization: Bearer``. Scripts
send it in their hello, see :mod:`ai4u_edu.page.server.scripts.agent_lease`.
"""

import hashlib
from hmac import compare_digest
from secrets import token_urlsafe
from urllib.parse import quote, urlencode

from starlette.requests import HTTPConnection
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.host_origin import is_loopback
from ai4u_edu.page.server.limits.attempts import (
    AttemptResult,
    Attempts,
    client_address,
    too_many_text,
)
from ai4u_edu.page.server.limits.socket_close import NOT_ALLOWED, TRY_LATER, refuse_socket
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.page.server.token_page import TokenPage, wants_page

MIN_TOKEN_CHARS = 8
"""Length of a token that a person chooses."""


def token_for(host: str, wanted: str = "") -> str:
    """Return the token to ask for when listening at an address; empty for none.

    Args:
        host: the address.
        wanted: a token chosen by a person; default: a random one if one is needed.

    Raises:
        SetupError: the chosen token is too short.

    >>> token_for("127.0.0.1"), token_for("127.0.0.1", "sesame sesame")
    ('', 'sesame sesame')
    >>> len(token_for("0.0.0.0"))
    32
    """
    if wanted and len(wanted) < MIN_TOKEN_CHARS:
        raise SetupError(
            _(
                "--token: expected at least {fewest} characters, got {n}",
                fewest=MIN_TOKEN_CHARS,
                n=len(wanted),
            )
        )
    return wanted or ("" if is_loopback(host) else token_urlsafe(24))


def with_token(url: str, token: str) -> str:
    """Return a page's address with the token in it.

    >>> with_token("http://teacher:8080/", "a b"), with_token("http://teacher:8080", "")
    ('http://teacher:8080/?token=a%20b', 'http://teacher:8080')
    """
    return f"{url.rstrip('/')}/?token={quote(token, safe='')}" if token else url


def is_same_secret(secret: str, other: str) -> bool:
    """Compare two secrets in constant time."""
    return compare_digest(secret.encode(), other.encode())


class PageCookie:
    """Cookie of a browser that has opened an address with the right token.

    Browsers send a cookie to all ports of a machine: so its name differs for each token. Its value
    is a digest, since a token may have characters that a cookie can't.

    Args:
        token: the token.
    """

    def __init__(self, token: str) -> None:
        digest = hashlib.sha256(b"ai4u-edu page " + token.encode()).hexdigest()
        self.name, self.value = f"ai4u-edu-{digest[:8]}", digest[8:]

    def is_in(self, given: HTTPConnection) -> bool:
        """Return True if a request has the cookie."""
        return is_same_secret(self.value, given.cookies.get(self.name, ""))


class TokenAuth:
    """ASGI middleware around one route that asks for the token.

    Args:
        app: the protected app.
        token: the room's token; empty to ask for none.
        attempts: rate limit for wrong tokens, shared by all routes of a room.
        token_page: for the routes of pages, which set the cookie: what a browser without the token
            gets. Others get a line of text.
    """

    def __init__(
        self,
        app: ASGIApp,
        token: str,
        *,
        attempts: Attempts | None = None,
        token_page: TokenPage | None = None,
    ) -> None:
        self._app = app
        self._token = token
        self._attempts = attempts or Attempts()
        self._token_page = token_page
        self._cookie = PageCookie(token)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or answer it with 401 or a socket's close 1008, and the reason."""
        if not self._token:
            await self._app(scope, receive, send)
            return
        given = HTTPConnection(scope)
        verdict = AttemptResult.WRONG
        if self._has_credentials(given):
            address = client_address(scope)
            verdict = await self._attempts.check(address, lambda: self._is_known(given))
        if verdict is not AttemptResult.RIGHT:
            await self._refuse(given, verdict, scope, receive, send)
        elif self._token_page and scope["type"] == "http" and self._is_in_address(given):
            await self._redirect(given)(scope, receive, send)
        else:
            await self._app(scope, receive, send)

    def _has_credentials(self, given: HTTPConnection) -> bool:
        """Return True if a token or cookie is given, right or wrong."""
        return _has_token(given) or self._cookie.name in given.cookies

    def _is_in_address(self, given: HTTPConnection) -> bool:
        return is_same_secret(self._token, given.query_params.get("token", ""))

    def _is_known(self, given: HTTPConnection) -> bool:
        return (
            self._is_in_address(given)
            or self._cookie.is_in(given)
            or is_same_secret(f"Bearer {self._token}", given.headers.get("authorization", ""))
        )

    def _redirect(self, given: HTTPConnection) -> Response:
        """Return a redirect to the page's address without the token, with the cookie."""
        page = given.url.path.rpartition("/")[2]
        rest = [(name, value) for name, value in given.query_params.multi_items()]
        query = urlencode([(name, value) for name, value in rest if name != "token"])
        response = RedirectResponse(f"./{page}?{query}" if query else f"./{page}", 303)
        response.headers["Cache-Control"] = "no-store"
        response.set_cookie(
            self._cookie.name,
            self._cookie.value,
            path=None,  # the page's own, which a proxy may have changed
            secure=given.url.scheme == "https",
            httponly=True,
            samesite="lax",  # with "strict" a link in a mail or a chat would not open the page
        )
        return response

    async def _refuse(
        self,
        given: HTTPConnection,
        verdict: AttemptResult,
        scope: Scope,
        receive: Receive,
        send: Send,
    ) -> None:
        is_limited = verdict is AttemptResult.TOO_MANY
        seconds = self._attempts.retry_after(client_address(scope)) or 1
        why: str = _(
            "expected this world's token, got none; open the address with ?token=... that its "
            "terminal shows"
        )
        if is_limited:
            why = too_many_text(seconds)
        elif _has_token(given):
            why = _(
                "expected this world's token, got another one; open the address with ?token=... "
                "that its terminal shows"
            )
        if scope["type"] == "websocket":
            code = TRY_LATER if is_limited else NOT_ALLOWED
            await refuse_socket(scope, receive, send, code, why)
            return
        response: Response = TextResponse(_("token: {problem}", problem=why))
        if self._token_page and wants_page(given):
            response = self._token_page.response(
                is_wrong=_has_token(given), wait_s=is_limited * seconds
            )
        response.status_code = 429 if is_limited else 401
        response.headers["Cache-Control"] = "no-store"
        if is_limited:
            response.headers["Retry-After"] = str(seconds)
        else:
            response.headers["WWW-Authenticate"] = "Bearer"
        await response(scope, receive, send)


def _has_token(given: HTTPConnection) -> bool:
    return "token" in given.query_params or "authorization" in given.headers
