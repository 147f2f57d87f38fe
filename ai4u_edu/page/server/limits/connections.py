"""Limits of a server's connections, total and by address, with eviction of idle ones.

Each connection takes a file descriptor, and a page's takes two more towards viser. The total limit
depends on the process's limit of descriptors. A connection that waits for its other side is *idle*:
for a complete request, for the next one, for more of an answer to be read, or for the end of a
WebSocket whose app has ended. At a limit, a new connection evicts the one that is idle for longest.
"""

import ipaddress
import sys
from asyncio import Transport
from typing import Any

from ai4u_edu.locale import gettext as _

MAX_PER_ADDRESS = 120
"""Limit for one address. Each page has two connections, and a few more while it loads."""
MAX_CONNECTIONS = 1000
MIN_CONNECTIONS = 16
RESERVED_DESCRIPTORS = 128
"""File descriptors that are reserved for everything else: files, viser, scripts."""
DESCRIPTORS_EACH = 3
"""File descriptors of a connection: its own, and both ends of one to viser."""
WANTED_DESCRIPTORS = 4096
"""File descriptors that a command asks for its process."""
MAX_EVICTING = 32
"""Evicted connections that are not closed yet; each still has its descriptor."""
MAX_STARTING = MIN_CONNECTIONS // 2
"""Admitted connections without a transport yet; no newer one can evict them."""
THIS_MACHINE = "this machine"
IPV6_PREFIX = 64
"""Length of an IPv6 network's prefix; one client may use all addresses of its network."""


class Connections:
    """The connections of a server, by the address of their other end. Belongs to its event loop.

    Args:
        limit: of all connections; default: what the process's limit of descriptors allows.
        per_address: of one address. This machine has no limit besides ``limit``: a proxy on it may
            stand for any number of clients.
    """

    def __init__(self, limit: int | None = None, per_address: int = MAX_PER_ADDRESS) -> None:
        self.limit = limit or max_connections()
        self.per_address = per_address
        self.is_closing = False
        """True once the server shuts down: it accepts nothing, and aborts what it just accepted."""
        self.evicting = 0
        """Number of evicted connections that are not closed yet."""
        self._connections: dict[int, _Connection] = {}
        self._by_address: dict[str, int] = {}
        self._starting: set[int] = set()
        self._idle: dict[int, _Connection] = {}  # the longest idle one first

    def __len__(self) -> int:
        return len(self._connections)

    def are_waiting(self) -> bool:
        """Return True if no more should be admitted before the event loop has had a turn."""
        return self.evicting >= MAX_EVICTING or len(self._starting) >= MAX_STARTING

    def admit(self, descriptor: int, peer: Any) -> str:
        """Admit a connection, and evict an idle one if there is no room.

        Args:
            descriptor: the socket's file descriptor. The address of the other end would not do:
                a port may be used again before the socket of its former connection is closed.
            peer: the socket's address of the other end.

        Returns:
            The reason if it is refused, else an empty text.
        """
        address = address_of(peer)
        is_full = self._by_address.get(address, 0) >= self.per_address
        if is_full and address != THIS_MACHINE and not self._evict(address):
            return _(
                "expected at most {per_address} connections from one address, got another "
                "one from {address}; close some pages, or start with --connections N",
                per_address=self.per_address,
                address=address,
            )
        if len(self._connections) - self.evicting >= self.limit and not self._evict():
            return _(
                "expected at most {limit} connections, got another one; try again later",
                limit=self.limit,
            )
        self._connections[descriptor] = _Connection(address)
        self._starting.add(descriptor)
        self._by_address[address] = self._by_address.get(address, 0) + 1
        return ""

    def leave(self, descriptor: int) -> None:
        """Remove a connection whose socket is closed."""
        connection = self._connections.pop(descriptor, None)
        if connection is None:
            return
        self._starting.discard(descriptor)
        self._idle.pop(descriptor, None)
        if connection.is_evicted:
            self.evicting -= 1
        else:
            self._uncount(connection)

    def set_idle(self, transport: Transport, idle: bool) -> None:
        """Mark a connection as idle or not; ignore one that was not admitted here."""
        descriptor = transport.get_extra_info("socket").fileno()
        connection = self._connections.get(descriptor)
        if connection is None or connection.is_evicted:
            return
        connection.transport = transport
        self._starting.discard(descriptor)
        self._idle.pop(descriptor, None)
        if idle:
            self._idle[descriptor] = connection

    def _evict(self, address: str | None = None) -> bool:
        """Abort the connection that is idle for longest, of an address or of all."""
        for descriptor, connection in self._idle.items():
            if address in (None, connection.address) and connection.transport is not None:
                del self._idle[descriptor]
                connection.is_evicted = True
                self.evicting += 1
                self._uncount(connection)
                connection.transport.abort()
                return True
        return False

    def _uncount(self, connection: "_Connection") -> None:
        left = self._by_address[connection.address] - 1
        if left:
            self._by_address[connection.address] = left
        else:
            del self._by_address[connection.address]


class _Connection:
    __slots__ = ("address", "is_evicted", "transport")

    def __init__(self, address: str) -> None:
        self.address = address
        self.transport: Transport | None = None
        self.is_evicted = False


def address_of(peer: Any) -> str:
    """Return a text that is the same for all addresses that one machine may have.

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
