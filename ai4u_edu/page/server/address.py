"""Bind a listening socket, with errors that say how to mend them."""

import errno
import os
import socket

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import gettext as _

WILDCARD_HOSTS = {"": "127.0.0.1", "0.0.0.0": "127.0.0.1", "::": "::1"}  # noqa: S104 - read, not bound
"""Hosts that mean all addresses of this machine, each with its loopback address."""


class AddressError(AI4UError):
    """The server can't listen at this address."""


class PortTakenError(AddressError):
    """The port is taken by another program."""


def listen(host: str, port: int) -> socket.socket:
    """Return a listening socket, bound before anything else starts.

    Args:
        host: a name or an address of this machine.
        port: 0 for a free one.

    Raises:
        PortTakenError: another program listens there.
        AddressError: it can't listen there, for another reason.
    """
    try:
        family, kind, protocol, _name, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
    except (OSError, UnicodeError) as error:
        raise AddressError(
            _(
                "expected an address of this machine, got --host {host!r} ({problem}); use "
                "--host 127.0.0.1",
                host=host,
                problem=str(error),
            )
        ) from None
    # the protocol is passed on because asyncio sets TCP_NODELAY only for sockets that name TCP;
    # without it a small frame that follows another one waits for up to 40 ms
    listener = socket.socket(family, kind, protocol)
    try:
        if os.name == "posix":  # elsewhere it would let two programs share a port
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen()
    except OSError as error:
        listener.close()
        raise _explained(error, host, port) from None
    return listener


def url_of(host: str, listener: socket.socket) -> str:
    """Return the address under which a browser on this machine finds the page."""
    host = WILDCARD_HOSTS.get(host, host)
    shown = f"[{host}]" if ":" in host else host
    return f"http://{shown}:{listener.getsockname()[1]}/"


def _explained(error: OSError, host: str, port: int) -> AddressError:
    if error.errno == errno.EADDRINUSE:
        return PortTakenError(
            _(
                "port {port} is taken by another program (or another AI4U Edu); use --port "
                "0 for a free one, or --port {port2}",
                port=port,
                port2=port + 1,
            )
        )
    if error.errno == errno.EACCES:
        return AddressError(
            _(
                "port {port} is not allowed to you ({problem}); use --port 0",
                port=port,
                problem=str(error),
            )
        )
    return AddressError(
        _(
            "expected an address of this machine, got --host {host!r} ({problem}); use "
            "--host 127.0.0.1",
            host=host,
            problem=str(error),
        )
    )
