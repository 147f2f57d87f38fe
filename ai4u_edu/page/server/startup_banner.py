"""Start of a served room for a person: addresses in the terminal, and the page on the desktop."""

import os
import socket
import sys
import webbrowser
from urllib.parse import urlsplit

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join as joined
from ai4u_edu.page.server.address import WILDCARD_HOSTS
from ai4u_edu.page.server.host_origin import is_loopback
from ai4u_edu.page.server.token_auth import with_token

_UNUSED_ADDRESS = ("192.0.2.1", 9)  # reserved for documentation


def startup_banner(title: str, host: str, url: str, token: str) -> str:
    """Return the addresses of a room, and a warning if other machines can reach it.

    Args:
        title: the room's title.
        host: address that the server listens at.
        url: the page's address, on this machine.
        token: the room's token; empty for none.

    >>> print(startup_banner("Box chase", "127.0.0.1", "http://127.0.0.1:8080/", ""))
    Box chase is served at http://127.0.0.1:8080/  (Ctrl-C ends it)
    >>> print(startup_banner("Maze", "10.0.0.5", "http://10.0.0.5:8080/", "sesame sesame"))
    Maze is served at http://10.0.0.5:8080/?token=sesame%20sesame  (Ctrl-C ends it)
    Other machines can reach it. Page, API and scripts are asked for the token in this address:
    give it only to those who may drive.
    """
    lines: list[str] = [
        _(
            "{title} is served at {address}  (Ctrl-C ends it)",
            title=title,
            address=with_token(url, token),
        )
    ]
    if not is_loopback(host):
        if host in WILDCARD_HOSTS:
            others = f"http://{own_address()}:{urlsplit(url).port}/"
            lines.append(_("from other machines: {address}", address=with_token(others, token)))
        lines.append(
            _(
                "Other machines can reach it. Page, API and scripts are asked for the token "
                "in this address:\ngive it only to those who may drive."
            )
        )
    return joined(lines, "\n")


def own_address() -> str:
    """Return this machine's address in its network; its host name if it has none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(_UNUSED_ADDRESS)  # a UDP socket sends nothing here, it only picks a route
        except OSError:
            return socket.gethostname()
        return str(probe.getsockname()[0])


def open_on_desktop(url: str) -> bool:
    """Open a page if there is a desktop; return True if it was opened."""
    # without a desktop a text browser might open, and take over the terminal
    desktop = sys.platform in {"win32", "darwin"} or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )
    return desktop and webbrowser.open(url)
