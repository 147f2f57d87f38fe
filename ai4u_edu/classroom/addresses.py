"""Addresses of a class, and what the terminal says of them."""

from urllib.parse import quote, urlsplit

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join as joined
from ai4u_edu.page.server.address import WILDCARD_HOSTS
from ai4u_edu.page.server.host_origin import is_loopback
from ai4u_edu.page.server.startup_banner import own_address


def join_address(host: str, url: str) -> str:
    """Return the address that students open.

    Args:
        host: address that the server listens at.
        url: address under which somebody has a page of the class.

    >>> join_address("10.0.0.5", "http://10.0.0.5:8080/")
    'http://10.0.0.5:8080/'
    """
    parts = urlsplit(url)
    if host in WILDCARD_HOSTS and is_loopback(parts.hostname or ""):
        return f"{parts.scheme}://{own_address()}:{parts.port}/"
    return url


def teacher_address(url: str, token: str) -> str:
    """Return the address of the teacher's page, with its secret."""
    return f"{url}teacher?token={quote(token, safe='')}"


def class_banner(join: str, code: str, url: str, token: str) -> str:
    """Return what the terminal shows when a class is served.

    >>> print(class_banner("http://10.0.0.5:8080/", "KVBTM", "http://127.0.0.1:8080/", "sesame"))
    Students open  http://10.0.0.5:8080/  and type the code  KVBTM
    You open       http://127.0.0.1:8080/teacher?token=sesame
    The second address is yours alone. Ctrl-C ends the class; started again with the same
    --folder, it goes on where it was.
    """
    lines: list[str] = [
        _("Students open  {join}  and type the code  {code}", join=join, code=code),
        _("You open       {address}", address=teacher_address(url, token)),
        _(
            "The second address is yours alone. Ctrl-C ends the class; started again with the "
            "same\n--folder, it goes on where it was."
        ),
    ]
    if is_loopback(urlsplit(join).hostname or ""):
        lines.append(_("Only this machine can reach it. For others: --host 0.0.0.0"))
    return joined(lines, "\n")
