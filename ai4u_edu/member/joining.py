"""Joining of a class over HTTP, as its join page does it."""

import re
from dataclasses import dataclass
from typing import Any, Literal
from urllib.parse import urlsplit
from uuid import uuid4

import httpx

from ai4u_edu.base.errors import shorten
from ai4u_edu.member.errors import NotJoinedError, UnreachableError

SEAT_COOKIE = "ai4u_edu_seat"
"""Cookie with a seat's token from a program; those from a class go on with a name of its own, as
cookies know no ports. Scripts in a page can't read it."""
CONNECT_TIMEOUT_S = 10.0
"""Time in which the class's machine has to be reached."""
ANSWER_TIMEOUT_S = 90.0
"""Time for an answer: after many wrong codes from a school's network, the class lets the right one
wait up to a minute for its turn."""
TIMEOUT = httpx.Timeout(ANSWER_TIMEOUT_S, connect=CONNECT_TIMEOUT_S)
MAX_NAME_ROUNDS = 5
"""Limit of lists of names to ask for; a whole class may choose from the same few at once."""
MAX_SENTENCE_CHARS = 300
ProgramKind = Literal["play", "notebook"]
_ROOM_PATH = re.compile(r"/r/\w+/?$")


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
            "expected the address of the class that the teacher shows, such as "
            f"http://192.168.0.10:8080, got {shorten(repr(url), 80)}"
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
        raise NotJoinedError(f"name choice: expected a number from 1 on, got {name_choice}")
    if not code.strip():
        raise NotJoinedError("expected the code on the board, such as BCDFG, got none")
    request = request or str(uuid4())
    with _client(address, held) as client:
        for _ in range(MAX_NAME_ROUNDS):
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
    raise NotJoinedError("Others were faster with every name that was offered. Try again.")


def is_seat_valid(seat: Seat) -> bool:
    """Return True if the class still knows the seat.

    Raises:
        UnreachableError: nobody answers there.
    """
    with _client(seat.url, seat.token) as client:
        answer = _ask(client, "GET", "")
        return answer.status_code == 303


def _client(address: str, token: str) -> httpx.Client:
    cookies = {SEAT_COOKIE: token} if token else None
    # a class is near: what the environment says of proxies is for the Internet
    return httpx.Client(base_url=address, timeout=TIMEOUT, cookies=cookies, trust_env=False)


def _ask(client: httpx.Client, method: str, path: str, **rest: Any) -> httpx.Response:
    """Send a request, and once more if its answer was lost."""
    try:
        try:
            return client.request(method, path, **rest)
        except (httpx.ReadError, httpx.RemoteProtocolError):
            return client.request(method, path, **rest)
    except httpx.ConnectTimeout:
        why = f"no connection within {CONNECT_TIMEOUT_S:g} s"
    except httpx.TimeoutException:
        why = f"no answer within {ANSWER_TIMEOUT_S:g} s"
    except httpx.TransportError as error:
        why = str(error) or type(error).__name__
    raise UnreachableError(
        f"The class at {client.base_url} can't be reached ({why}). Is the address right, and is "
        "this computer in the same network?"
    )


def _names(client: httpx.Client) -> list[str]:
    answer = _ask(client, "GET", "api/names")
    names = _field(answer, "names") if answer.status_code == 200 else None
    if not isinstance(names, list) or not all(isinstance(each, str) for each in names):
        raise NotJoinedError(
            f"There is no class at {client.base_url} (answer {answer.status_code}). Use the "
            "address that the teacher shows."
        )
    if not names:
        raise NotJoinedError("The class has no name left. Ask your teacher.")
    return names


def _seat_of(answer: httpx.Response, name: str, address: str) -> Seat:
    token = next(
        (value for name, value in answer.cookies.items() if name.startswith(SEAT_COOKIE)), ""
    )
    if not token:
        raise NotJoinedError(f"The class at {address} gave no seat. Is it of the same version?")
    named, colour = _field(answer, "name"), _field(answer, "colour")
    return Seat(
        token,
        named if isinstance(named, str) else name,
        colour if isinstance(colour, str) else "",
        address,
    )


def _problem_of(answer: httpx.Response, address: str) -> str:
    problem = _field(answer, "problem")
    if isinstance(problem, str) and problem:
        return shorten(problem, MAX_SENTENCE_CHARS)
    return f"The class at {address} could not answer (status {answer.status_code}). Try again."


def _field(answer: httpx.Response, name: str) -> object:
    """Return a field of a JSON object; None if there is none."""
    try:
        body = answer.json()
    except ValueError:
        return None
    return body.get(name) if isinstance(body, dict) else None
