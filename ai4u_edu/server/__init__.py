"""One port for everything: the page, viser behind it, the keys, and an API to look."""

from ai4u_edu.server.address import AddressError, PortTakenError
from ai4u_edu.server.announce import announcement
from ai4u_edu.server.app import RoomMount, room_app
from ai4u_edu.server.desktop import open_on_desktop
from ai4u_edu.server.door import LOOPBACK, hosts_for
from ai4u_edu.server.guard import token_for, with_token
from ai4u_edu.server.remote import Rules
from ai4u_edu.server.serve import ServerThread, serve
from ai4u_edu.server.side_door import shut_side_door

__all__ = [
    "LOOPBACK",
    "AddressError",
    "PortTakenError",
    "RoomMount",
    "Rules",
    "ServerThread",
    "announcement",
    "hosts_for",
    "open_on_desktop",
    "room_app",
    "serve",
    "shut_side_door",
    "token_for",
    "with_token",
]
