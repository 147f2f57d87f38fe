"""Requests to the API of a JupyterHub: the user of a token, and the token of a browser."""

import hashlib
import re
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import httpx

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.no_cookies import no_cookies
from ai4u_edu.classroom.open_limits import sign_ins
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.attempts import CodeLimit
from ai4u_edu.page.server.limits.concurrency_limit import TooManyOpenError

TIMEOUT_S = 10.0
CACHE_S = 60.0
"""Cache lifetime of a token's user; someone who has left the hub keeps access for that long."""
MAX_CACHED = 1000
TOO_MANY = _("Too many sign-ins come from your network. Try again in a moment.")
_TOKEN = re.compile(r"[!-~]+")


class HubUnreachableError(AI4UError):
    """The hub does not answer now; the same request may succeed later."""


class NoAccessError(AI4UError):
    """The hub knows the token, but it does not allow the use of the class."""


@dataclass(frozen=True)
class HubUser:
    """A user of the hub. In memory only: the class stores no name."""

    name: str
    is_admin: bool
    groups: frozenset[str]


class HubApi:
    """The hub's API. Belongs to one event loop.

    Args:
        hub: environment of the service.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(self, hub: HubEnvironment, clock: Callable[[], float] = time.monotonic) -> None:
        self._hub, self._clock = hub, clock
        self._client = httpx.AsyncClient(timeout=TIMEOUT_S, trust_env=False, cookies=no_cookies())
        self._limit, self._asking = CodeLimit(clock), sign_ins()
        self._cached: OrderedDict[bytes, tuple[float, HubUser]] = OrderedDict()

    async def user_of(self, token: str, address: str = "") -> HubUser | None:
        """Return the user of a token; None if the hub does not know it, or it is a service's.

        After many wrong tokens from an address, the hub is asked about its tokens one by one.

        Args:
            token: from a browser or a program.
            address: of its sender.

        Raises:
            HubUnreachableError: the hub does not answer, or must not be asked now.
            NoAccessError: the token is not for this service.
        """
        key = hashlib.sha256(token.encode()).digest()
        until, user = self._cached.get(key, (0.0, None))
        if user is not None and self._clock() < until:
            return user
        self._cached.pop(key, None)
        try:
            async with self._asking.one_of(address):
                if not await self._limit.wait_for_turn(address):
                    raise HubUnreachableError(TOO_MANY)
                found = await self._whoami(token)
        except TooManyOpenError:
            raise HubUnreachableError(TOO_MANY) from None
        if found is None or found.get("kind") != "user":
            self._limit.add_wrong(address)
            return None
        if not set(self._hub.access_scopes) & set(found.get("scopes") or ()):
            raise NoAccessError(
                _(
                    "expected a token of the hub with the scope {access_scopes}, got one "
                    "without it. Whoever runs the hub can add it: docs/jupyterhub.md has the "
                    "settings.",
                    access_scopes=self._hub.access_scopes[1],
                )
            )
        user = HubUser(
            str(found["name"]),
            bool(found.get("admin")),
            frozenset(map(str, found.get("groups") or ())),
        )
        self._cached[key] = self._clock() + CACHE_S, user
        if len(self._cached) > MAX_CACHED:
            self._cached.popitem(last=False)
        return user

    async def token_for(self, code: str, verifier: str) -> str:
        """Return the token for the code that a browser has brought; empty if it is not valid.

        Args:
            code: from the hub.
            verifier: secret of the request, of which the hub has got the digest (RFC 7636).

        Raises:
            HubUnreachableError: the hub does not answer.
        """
        form = {
            "client_id": self._hub.client_id,
            "client_secret": self._hub.api_token,
            "grant_type": "authorization_code",
            "code": code,
            "code_verifier": verifier,
            "redirect_uri": self._hub.redirect_uri,
        }
        answer = await self._ask("POST", "oauth2/token", data=form)
        return str(answer.json().get("access_token", "")) if answer.status_code == 200 else ""

    async def _whoami(self, token: str) -> dict[str, Any] | None:
        if not _TOKEN.fullmatch(token):  # it can't stand in a header
            return None
        answer = await self._ask("GET", "user", headers={"Authorization": f"token {token}"})
        if answer.status_code != 200:
            return None
        model: dict[str, Any] = answer.json()
        return model

    async def _ask(self, method: str, path: str, **rest: Any) -> httpx.Response:
        try:
            answer = await self._client.request(method, f"{self._hub.api_url}/{path}", **rest)
        except httpx.HTTPError as error:
            reason = str(error) or type(error).__name__
        else:
            if answer.status_code < 500:
                return answer
            reason = f"status {answer.status_code}"
        raise HubUnreachableError(
            _("The hub does not answer ({reason}). Try again in a moment.", reason=reason)
        )
