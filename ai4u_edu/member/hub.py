"""Joining of a class that is a service of a JupyterHub, from a student's server there.

The hub gives each server a token. With it, the class asks the hub who its user is; so nobody types
in an address or a code.
"""

import os
from collections.abc import Mapping
from typing import Any
from urllib.parse import quote, urlsplit

import httpx

from ai4u_edu.base.errors import shorten
from ai4u_edu.member.errors import NotJoinedError, UnreachableError
from ai4u_edu.member.joining import MAX_SENTENCE_CHARS, TIMEOUT, Seat

SERVICE = "ai4u-class"
"""Usual name of the hub's service."""
ADDRESS_VARIABLE = "AI4U_EDU_CLASS_URL"
"""Variable with the class's address, for hubs whose API must not tell it."""
NO_HUB = (
    "expected a server of a JupyterHub with a class, and this is none. Give the address of the "
    "class and the code on the board"
)
SEE_DOCS = "Whoever runs the hub finds the settings in docs/jupyterhub.md."


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


def join_at_hub(service: str = SERVICE, variables: Mapping[str, str] = os.environ) -> Seat:
    """Return the seat that this server's user has in the class, which gives one if needed.

    Args:
        service: name of the hub's service.
        variables: of the process.

    Raises:
        UnreachableError: the hub or the class does not answer.
        NotJoinedError: there is no hub or no class, or the class gives no seat.
    """
    if not is_at_hub(variables):
        raise NotJoinedError(NO_HUB)
    token = variables["JUPYTERHUB_API_TOKEN"]
    headers = {"Authorization": f"token {token}"}
    with httpx.Client(headers=headers, timeout=TIMEOUT, trust_env=False) as client:
        url = variables.get(ADDRESS_VARIABLE) or _class_address(client, service, variables)
        url = f"{url.rstrip('/')}/"
        answer = _ask(client, "POST", f"{url}api/hub-seat", "class")
    told = _fields(answer)
    if answer.status_code != 200 or not isinstance(told.get("name"), str):
        problem = told.get("problem")
        if isinstance(problem, str) and problem:
            raise NotJoinedError(shorten(problem, MAX_SENTENCE_CHARS))
        raise NotJoinedError(f"There is no class at {url} (answer {answer.status_code}).")
    return Seat(token, told["name"], str(told.get("colour", "")), url)


def _class_address(client: httpx.Client, service: str, variables: Mapping[str, str]) -> str:
    """Return the address of the service, as the hub's API tells it."""
    api = variables["JUPYTERHUB_API_URL"].rstrip("/")
    answer = _ask(client, "GET", f"{api}/services/{quote(service, safe='')}", "hub")
    told = _fields(answer)
    url, prefix = told.get("url"), told.get("prefix")
    if isinstance(url, str) and isinstance(prefix, str) and url and prefix:
        parts = urlsplit(url)
        return f"{parts.scheme}://{parts.netloc}{prefix}"
    raise NotJoinedError(
        f"This hub has no class that this server may use: it has no service {service!r}, or this "
        f"server's token lacks the scope read:services!service={service}. {SEE_DOCS}"
    )


def _ask(client: httpx.Client, method: str, url: str, who: str) -> httpx.Response:
    try:
        answer = client.request(method, url)
    except (httpx.TransportError, httpx.InvalidURL) as error:
        why = str(error) or type(error).__name__
    else:
        if answer.status_code < 500:
            return answer
        why = f"answer {answer.status_code}"
    raise UnreachableError(f"The {who} at {url} can't be reached ({why}). Try again in a moment.")


def _fields(answer: httpx.Response) -> dict[str, Any]:
    """Return the JSON object of an answer; an empty one if there is none."""
    try:
        body = answer.json()
    except ValueError:
        return {}
    return body if isinstance(body, dict) else {}
