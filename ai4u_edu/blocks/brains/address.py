"""Addresses of brains on the command line."""

from collections import Counter
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.locale import gettext as _

EXAMPLE = "ai4u://127.0.0.1:8080"
IN_FRONT = ("host", "port")
"""Parameters that stand in front of an address's question mark."""


def brain_at(address: str, **defaults: Any) -> RemoteBrain:
    """Return the brain at an address; its parameters may follow a question mark.

    Args:
        address: of the script.
        defaults: parameters for what the address does not name, such as the ``skip_frame`` of the
            brain that it replaces.

    Raises:
        SetupError: it is no such address, or names a parameter that it can't have.
        ParameterError: a parameter's value is wrong.

    >>> brain_at("ai4u://127.0.0.1:8090?mode=realtime&on_missing=stop")
    RemoteBrain(port=8090, mode='realtime', on_missing='stop')
    >>> brain_at("ai4u://127.0.0.1?skip_frame=0", skip_frame=9, repeat_action=False)
    RemoteBrain(skip_frame=0, repeat_action=False)
    >>> brain_at("http://127.0.0.1:8090")
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SetupError: brain: expected an address such as ai4u://127.0.0.1:8080, got \
'http://127.0.0.1:8090'
    """
    try:
        parts = urlsplit(address)
        port = parts.port
    except ValueError:
        parts, port = urlsplit(""), None
    is_plain = parts.path in ("", "/") and not parts.fragment and parts.username is None
    if parts.scheme != "ai4u" or not parts.hostname or not is_plain:
        raise SetupError(
            _(
                "brain: expected an address such as {example}, got {address}",
                example=EXAMPLE,
                address=repr(address),
            )
        )
    named = parse_qsl(parts.query, keep_blank_values=True)
    for name, count in Counter(name for name, _value in named).items():
        if name in IN_FRONT:
            raise SetupError(
                _(
                    "brain: expected {name} in front of the question mark, as in {example}, got "
                    "{address}",
                    name=name,
                    example=EXAMPLE,
                    address=repr(address),
                )
            )
        if name == "enabled":
            raise SetupError(
                _(
                    "brain: expected no enabled in an address, since whoever is named drives, got "
                    "{address}",
                    address=repr(address),
                )
            )
        if count > 1:
            raise SetupError(
                _(
                    "brain: expected {name} once, got it {count} times in {address}",
                    name=name,
                    count=count,
                    address=repr(address),
                )
            )
    place: dict[str, Any] = {"host": parts.hostname, "port": 8080 if port is None else port}
    return RemoteBrain(**(defaults | place | dict(named)))
