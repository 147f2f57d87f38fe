"""Limits of a class's open sockets and requests. A school is one address, so a seat has its own."""

from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit

MAX_STRANGER_SOCKETS = 50
"""Sockets of one address that nobody with a seat has: of the check page, and links before hello."""
STRANGER_SOCKET_S = 10.0
"""Longest life of such a socket."""
STRANGERS_SHARE = 0.2
"""Share of all connections that such sockets may have together."""
MAX_JOINS = 100
"""Requests to join from one address at the same time, such as a whole class's."""
MAX_SEAT_SOCKETS = 30
"""Sockets of one seat; a page has three, and a seat may have several devices."""
MAX_SEAT_REQUESTS = 30
"""Requests of one seat to its room at the same time; a browser sends six."""
SEATS_SHARE = 0.7
"""Share of all connections that all seats may have together, of sockets and of requests each."""


def sign_ins() -> ConcurrencyLimit:
    """Return the limit of requests whose code or token may have to wait for a turn, by address."""
    return ConcurrencyLimit(MAX_JOINS, STRANGERS_SHARE, what=_("requests"))


def stranger_sockets() -> ConcurrencyLimit:
    """Return the limit of sockets that anybody may open."""
    return ConcurrencyLimit(MAX_STRANGER_SOCKETS, STRANGERS_SHARE, STRANGER_SOCKET_S)


def seat_sockets() -> ConcurrencyLimit:
    """Return the limit of sockets of seats."""
    return ConcurrencyLimit(MAX_SEAT_SOCKETS, SEATS_SHARE)


def seat_requests() -> ConcurrencyLimit:
    """Return the limit of requests of seats to their rooms."""
    return ConcurrencyLimit(MAX_SEAT_REQUESTS, SEATS_SHARE, what=_("requests"))
