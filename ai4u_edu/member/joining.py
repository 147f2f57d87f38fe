"""A program's way to a seat of a class: by the join code, by a file that keeps it, or by a hub.

With a code, it asks the class as its join page does. On a JupyterHub each server has a token, with
which the class asks the hub who its user is: so nobody types in an address or a code.
"""

import hashlib
import json
import os
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote, urlsplit
from uuid import uuid4

import httpx

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, shorten
from ai4u_edu.locale import gettext as _

SEAT_COOKIE = "ai4u_edu_seat"
"""Cookie with a seat's token from a program; those from a class go on with a name of its own, as
cookies know no ports. Scripts in a page can't read it."""
CONNECT_TIMEOUT_S = 10.0
"""Time in which the class's machine has to be reached."""
ANSWER_TIMEOUT_S = 90.0
"""Time for an answer: after many wrong codes from a school's network, the class lets the right one
wait up to a minute for its turn."""
_TIMEOUT = httpx.Timeout(ANSWER_TIMEOUT_S, connect=CONNECT_TIMEOUT_S)
_MAX_NAME_ROUNDS = 5
"""Limit of lists of names to ask for; a whole class may choose from the same few at once."""
_MAX_SENTENCE_CHARS = 300
_HUB_ADDRESS = "AI4U_EDU_CLASS_URL"
"""Variable with the class's address, for hubs whose API does not give it."""
_MAX_SEATS = 20
"""Limit of the classes whose seat is kept; the oldest one is forgotten."""
ProgramKind = Literal["play", "notebook"]
_ROOM_PATH = re.compile(r"/r/\w+/?$")


class NotJoinedError(AI4UError):
    """A class gives no seat, or can't be asked; the message is for the person who wants to join."""


class UnreachableError(NotJoinedError):
    """Nobody answers at the class's address; the same attempt may succeed later."""


@dataclass(frozen=True)
class Seat:
    """A seat of a class."""

    token: str
    """Secret by which the class knows the seat."""
    name: str
    colour: str
    """Such as ``#d55e00``."""
    url: str
    """Address of the class; see :func:`class_address`."""


def class_address(url: str) -> str:
    """Return a class's address with scheme and slash at the end, made of what a person typed in.

    >>> class_address("teacher:8080")
    'http://teacher:8080/'
    >>> class_address("http://10.0.0.5:8080/r/a1b2/?code=KVBTM")
    'http://10.0.0.5:8080/'

    Raises:
        NotJoinedError: it is no address.
    """
    text = url.strip()
    try:
        parts = urlsplit(text if "://" in text else f"http://{text}")
        is_fine = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
        is_fine = is_fine and not re.search(r"\s", text)
        httpx.URL(text)
    except (ValueError, httpx.InvalidURL):
        is_fine = False
    if not is_fine:
        raise NotJoinedError(
            _(
                "expected the address of the class that the teacher shows, such as "
                "http://192.168.0.10:8080, got {url}",
                url=shorten(repr(url), 80),
            )
        )
    path = _ROOM_PATH.sub("/", parts.path)
    return f"{parts.scheme}://{parts.netloc}{path.rstrip('/')}/"


def join(
    url: str,
    code: str,
    name_choice: int = 1,
    request: str = "",
    held: str = "",
    kind: ProgramKind = "play",
) -> Seat:
    """Join a class, and return the seat.

    Args:
        url: address of the class.
        code: join code.
        name_choice: number of the name to take among those that are offered, from 1. If somebody
            else takes it meanwhile, the next one is taken.
        request: random id of this attempt, of 16 to 64 letters, digits and hyphens; repeated with
            the same id, the class gives the same seat. Left out, a new one.
        held: token of the seat that this program had; the class gives that seat again if it can.
        kind: program that joins.

    Raises:
        UnreachableError: nobody answers there.
        NotJoinedError: the code is wrong, the class is full or closed, or there is none.
    """
    address = class_address(url)
    if name_choice < 1:
        raise NotJoinedError(
            _(
                "name choice: expected a number from 1 on, got {name_choice}",
                name_choice=name_choice,
            )
        )
    if not code.strip():
        raise NotJoinedError(_("expected the code on the board, such as BCDFG, got none"))
    request = request or str(uuid4())
    with _client(address, held) as client:
        for _number in range(_MAX_NAME_ROUNDS):
            names = _names(client)
            first = (name_choice - 1) % len(names)
            for name in names[first:] + names[:first]:
                body = {"code": code, "name": name, "request": request, "kind": kind}
                answer = _ask(client, "POST", "api/join", json=body)
                if answer.status_code == 409:
                    continue
                if answer.status_code != 200:
                    raise NotJoinedError(_problem_of(answer, address))
                return _seat_of(answer, name, address)
    raise NotJoinedError(_("Others were faster with every name that was offered. Try again."))


def is_seat_valid(seat: Seat) -> bool:
    """Return True if the class still knows the seat.

    Raises:
        UnreachableError: nobody answers there.
    """
    with _client(seat.url, seat.token) as client:
        answer = _ask(client, "GET", "")
        return answer.status_code == 303


class SeatFile:
    """The latest seat in each class, by the class's address.

    The code and whatever a person typed in are not in it.

    Args:
        path: of the file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def take(self, url: str, code: str, name_choice: int = 1, kind: ProgramKind = "play") -> Seat:
        """Return the seat that is kept, if the class still knows it; else join.

        If the class can't be reached, the kept seat is returned, too.

        Raises:
            UnreachableError: nobody answers there, and no seat is kept.
            NotJoinedError: the class gives no seat; the message says why.
        """
        kept = self.seats().get(class_address(url))
        if kept is not None:
            try:
                if is_seat_valid(kept):
                    return kept
            except UnreachableError:
                return kept
        held = kept.token if kept else ""
        seat = join(url, code, name_choice, held=held, kind=kind)
        self._keep(seat)
        return seat

    def folder(self, seat: Seat) -> Path:
        """Return the folder for a seat's files; those of another seat don't get into it."""
        digest = hashlib.sha256(f"{seat.url} {seat.token}".encode()).hexdigest()
        return self.path.parent / f"class-{digest[:16]}"

    def seats(self) -> dict[str, Seat]:
        """Return the seats by address; none if the file is damaged."""
        with suppress(OSError, ValueError, TypeError, KeyError, AttributeError):
            read: Any = json.loads(self.path.read_text(encoding="utf-8"))
            return {each["url"]: _seat_in(each) for each in read["seats"]}
        return {}

    def _keep(self, seat: Seat) -> None:
        others = [each for each in self.seats().values() if each.url != seat.url]
        seats = [asdict(each) for each in [*others, seat][-_MAX_SEATS:]]
        with suppress(OSError):  # the next start joins again
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(self.path, json.dumps({"seats": seats}, indent=1), mode=0o600)


def is_at_hub(variables: Mapping[str, str] = os.environ) -> bool:
    """Return True in a server that a JupyterHub has started.

    >>> is_at_hub({"JUPYTERHUB_API_TOKEN": "t", "JUPYTERHUB_API_URL": "http://hub:8081/hub/api"})
    True
    """
    return all(variables.get(each) for each in ("JUPYTERHUB_API_TOKEN", "JUPYTERHUB_API_URL"))


def page_at_hub(path: str, variables: Mapping[str, str] = os.environ) -> str:
    """Return the path of a page of this server, below the hub's own; empty if there is no hub.

    Args:
        path: below the server's own.
        variables: of the process.

    >>> page_at_hub("proxy/4000/", {"JUPYTERHUB_SERVICE_PREFIX": "/user/ada/",
    ...     "JUPYTERHUB_BASE_URL": "/"})
    'user/ada/proxy/4000/'
    """
    prefix = variables.get("JUPYTERHUB_SERVICE_PREFIX", "")
    base = variables.get("JUPYTERHUB_BASE_URL", "/")
    return f"{prefix.rstrip('/')}/{path}".removeprefix(base) if prefix else ""


def join_at_hub(service: str = "ai4u-class", variables: Mapping[str, str] = os.environ) -> Seat:
    """Return the seat that this server's user has in the class, which gives one if needed.

    Args:
        service: name of the hub's service.
        variables: of the process.

    Raises:
        UnreachableError: the hub or the class does not answer.
        NotJoinedError: there is no hub or no class, or the class gives no seat.
    """
    if not is_at_hub(variables):
        raise NotJoinedError(
            _(
                "expected a server of a JupyterHub with a class, and this is none. Give the "
                "address of the class and the code on the board"
            )
        )
    token = variables["JUPYTERHUB_API_TOKEN"]
    headers = {"Authorization": f"token {token}"}
    with httpx.Client(headers=headers, timeout=_TIMEOUT, trust_env=False) as client:
        url = variables.get(_HUB_ADDRESS) or _class_address(client, service, variables)
        url = f"{url.rstrip('/')}/"
        answer = _ask_hub(client, "POST", f"{url}api/hub-seat", "class")
    told = _fields(answer)
    if answer.status_code != 200 or not isinstance(told.get("name"), str):
        problem = told.get("problem")
        if isinstance(problem, str) and problem:
            raise NotJoinedError(shorten(problem, _MAX_SENTENCE_CHARS))
        raise NotJoinedError(
            _(
                "There is no class at {url} (answer {status_code}).",
                url=url,
                status_code=answer.status_code,
            )
        )
    return Seat(token, told["name"], str(told.get("colour", "")), url)


def _client(address: str, token: str) -> httpx.Client:
    cookies = {SEAT_COOKIE: token} if token else None
    # a class is near: what the environment says of proxies is for the Internet
    return httpx.Client(base_url=address, timeout=_TIMEOUT, cookies=cookies, trust_env=False)


def _ask(client: httpx.Client, method: str, path: str, **rest: Any) -> httpx.Response:
    """Send a request, and once more if its answer was lost."""
    try:
        try:
            return client.request(method, path, **rest)
        except (httpx.ReadError, httpx.RemoteProtocolError):
            return client.request(method, path, **rest)
    except httpx.ConnectTimeout:
        why: str = _("no connection within {limit:g} s", limit=CONNECT_TIMEOUT_S)
    except httpx.TimeoutException:
        why = _("no answer within {limit:g} s", limit=ANSWER_TIMEOUT_S)
    except httpx.TransportError as error:
        why = str(error) or type(error).__name__
    raise UnreachableError(
        _(
            "The class at {base_url} can't be reached ({why}). Is the address right, "
            "and is this computer in the same network?",
            base_url=str(client.base_url),
            why=why,
        )
    )


def _names(client: httpx.Client) -> list[str]:
    answer = _ask(client, "GET", "api/names")
    names = _fields(answer).get("names") if answer.status_code == 200 else None
    if not isinstance(names, list) or not all(isinstance(each, str) for each in names):
        raise NotJoinedError(
            _(
                "There is no class at {base_url} (answer {status_code}). Use the address "
                "that the teacher shows.",
                base_url=str(client.base_url),
                status_code=answer.status_code,
            )
        )
    if not names:
        raise NotJoinedError(_("The class has no name left. Ask your teacher."))
    return names


def _seat_of(answer: httpx.Response, name: str, address: str) -> Seat:
    token = next(
        (value for name, value in answer.cookies.items() if name.startswith(SEAT_COOKIE)), ""
    )
    if not token:
        raise NotJoinedError(
            _("The class at {address} gave no seat. Is it of the same version?", address=address)
        )
    named, colour = _fields(answer).get("name"), _fields(answer).get("colour")
    return Seat(
        token,
        named if isinstance(named, str) else name,
        colour if isinstance(colour, str) else "",
        address,
    )


def _problem_of(answer: httpx.Response, address: str) -> str:
    problem = _fields(answer).get("problem")
    if isinstance(problem, str) and problem:
        return shorten(problem, _MAX_SENTENCE_CHARS)
    return _(
        "The class at {address} could not answer (status {status_code}). Try again.",
        address=address,
        status_code=answer.status_code,
    )


def _seat_in(read: dict[str, Any]) -> Seat:
    seat = Seat(read["token"], read["name"], read["colour"], read["url"])
    if not all(isinstance(each, str) for each in asdict(seat).values()):
        raise TypeError(_("expected texts, got {read}", read=repr(read)))
    return seat


def _class_address(client: httpx.Client, service: str, variables: Mapping[str, str]) -> str:
    """Return the address of the service, as the hub's API gives it."""
    api = variables["JUPYTERHUB_API_URL"].rstrip("/")
    answer = _ask_hub(client, "GET", f"{api}/services/{quote(service, safe='')}", "hub")
    told = _fields(answer)
    url, prefix = told.get("url"), told.get("prefix")
    if isinstance(url, str) and isinstance(prefix, str) and url and prefix:
        parts = urlsplit(url)
        return f"{parts.scheme}://{parts.netloc}{prefix}"
    raise NotJoinedError(
        _(
            "This hub has no class that this server may use: it has no service "
            "{service!r}, or this server's token lacks the scope "
            "read:services!service={service}. Whoever runs the hub finds the settings "
            "in docs/jupyterhub.md.",
            service=service,
        )
    )


def _ask_hub(client: httpx.Client, method: str, url: str, who: str) -> httpx.Response:
    try:
        answer = client.request(method, url)
    except (httpx.TransportError, httpx.InvalidURL) as error:
        why = str(error) or type(error).__name__
    else:
        if answer.status_code < 500:
            return answer
        why = f"answer {answer.status_code}"
    raise UnreachableError(
        _(
            "The {who} at {url} can't be reached ({why}). Try again in a moment.",
            who=who,
            url=url,
            why=why,
        )
    )


def _fields(answer: httpx.Response) -> dict[str, Any]:
    """Return the JSON object of an answer; an empty one if there is none."""
    try:
        body = answer.json()
    except ValueError:
        return {}
    return body if isinstance(body, dict) else {}
