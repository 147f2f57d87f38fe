"""Limits of the connections that a server accepts, so that idle ones keep nobody out.

Each connection takes a file descriptor, and a page's takes two more towards viser. So there is a
limit for all of them, which depends on the process's own, and one for each address. A connection
that has no complete request yet, or waits for its next one, is *idle*: where a limit is reached,
the oldest idle one makes room for a new one.
"""

import ipaddress
import sys
from asyncio import BaseTransport, Transport
from collections.abc import Hashable
from typing import Any, cast

MAX_PER_ADDRESS = 120
"""Connections from one address. Each page has two, and a few more while it loads."""
MAX_CONNECTIONS = 1000
MIN_CONNECTIONS = 16
RESERVED_DESCRIPTORS = 128
"""File descriptors that are kept for everything else: files, viser, scripts."""
DESCRIPTORS_EACH = 3
"""File descriptors that a connection may take: its own, and both ends of one to viser."""
WANTED_DESCRIPTORS = 4096
"""File descriptors that a command wants for its process."""
MAX_EVICTING = 32
"""Idle connections that may be about to be closed at a time; each still has its descriptor."""
THIS_MACHINE = "this machine"
IPV6_PREFIX = 64
"""Bits of an IPv6 address that tell networks apart; who has one network has all its addresses."""


class Connections:
    """The connections of a server, by the address of their other end. Belongs to its event loop.

    Args:
        most: of all addresses together; left out, as the process's limit of descriptors allows.
        per_address: of one address. This machine's own has no limit besides ``most``: a proxy on
            it may stand for any number of others.
    """

    def __init__(self, most: int | None = None, per_address: int = MAX_PER_ADDRESS) -> None:
        self.most = most or max_connections()
        self.per_address = per_address
        self.evicting = 0
        """Connections that were told to end, and have not yet."""
        self._places: dict[Hashable, _Place] = {}
        self._by_address: dict[str, int] = {}
        self._idle: dict[Hashable, _Place] = {}  # the longest idle one first

    def __len__(self) -> int:
        return len(self._places)

    def admit(self, peer: Any) -> str:
        """Admit a connection, at the cost of an idle one if need be.

        Args:
            peer: the socket's address of the other end.

        Returns:
            Why it is refused; empty if it is not.
        """
        address = address_of(peer)
        is_full = self._by_address.get(address, 0) >= self.per_address
        if is_full and address != THIS_MACHINE and not self._evict(address):
            return (
                f"expected at most {self.per_address} connections from one address, got another "
                f"one from {address}; close some pages, or start with --connections N"
            )
        if len(self._places) - self.evicting >= self.most and not self._evict():
            return f"expected at most {self.most} connections, got another one; try again later"
        place = self._places[peer] = _Place(address)
        self._idle[peer] = place
        self._by_address[address] = self._by_address.get(address, 0) + 1
        return ""

    def leave(self, peer: Any) -> None:
        """Forget a connection, whose socket is closed."""
        place = self._places.pop(peer, None)
        if place is None:
            return
        self._idle.pop(peer, None)
        if place.is_evicted:
            self.evicting -= 1
        else:
            self._count_off(place)

    def set_idle(self, transport: BaseTransport, idle: bool) -> None:
        """Note whether a connection waits for a request; nothing if it was not admitted here."""
        peer = transport.get_extra_info("peername")
        place = self._places.get(peer)
        if place is None or place.is_evicted:
            return
        place.transport = cast(Transport, transport)
        self._idle.pop(peer, None)
        if idle:
            self._idle[peer] = place

    def _evict(self, address: str | None = None) -> bool:
        """End the connection that is idle for the longest time, of an address or of all."""
        for peer, place in self._idle.items():
            if address in (None, place.address):
                if place.transport is None:  # it is so new that the loop has not met it yet
                    return False
                del self._idle[peer]
                place.is_evicted = True
                self.evicting += 1
                self._count_off(place)
                place.transport.abort()
                return True
        return False

    def _count_off(self, place: "_Place") -> None:
        left = self._by_address[place.address] - 1
        if left:
            self._by_address[place.address] = left
        else:
            del self._by_address[place.address]


class _Place:
    __slots__ = ("address", "is_evicted", "transport")

    def __init__(self, address: str) -> None:
        self.address = address
        self.transport: Transport | None = None
        self.is_evicted = False


def address_of(peer: Any) -> str:
    """Return what stands for all addresses that one machine may have.

    >>> address_of(("127.0.0.1", 50000)), address_of(("::ffff:10.0.0.7", 50000, 0, 0))
    ('this machine', '10.0.0.7')
    >>> address_of(("2001:db8:1:2:3::4", 50000, 0, 0))
    '2001:db8:1:2::/64'
    """
    host = str(peer[0]) if isinstance(peer, tuple) and peer else str(peer or "")
    try:
        address = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return host[:80]
    if isinstance(address, ipaddress.IPv6Address):
        address = address.ipv4_mapped or address
    if address.is_loopback:
        return THIS_MACHINE
    if isinstance(address, ipaddress.IPv6Address):
        return str(ipaddress.ip_network((address, IPV6_PREFIX), strict=False))
    return str(address)


def max_connections() -> int:
    """Return how many connections the process's limit of descriptors allows."""
    if sys.platform == "win32":
        return MAX_CONNECTIONS
    import resource

    soft, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft == resource.RLIM_INFINITY:
        return MAX_CONNECTIONS
    allowed = (soft - RESERVED_DESCRIPTORS) // DESCRIPTORS_EACH
    return max(MIN_CONNECTIONS, min(MAX_CONNECTIONS, allowed))


def raise_descriptor_limit() -> None:
    """Raise the process's limit of descriptors as far as a server may need; for commands only.

    Some systems begin with 256, which is too few for a class.
    """
    if sys.platform == "win32":
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = WANTED_DESCRIPTORS if hard == resource.RLIM_INFINITY else min(WANTED_DESCRIPTORS, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        try:
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        except (OSError, ValueError):  # some systems have another limit besides
            return
