"""One port for everything: the page, viser behind it, the keys, and an API to look."""

from ai4u_edu.server.address import AddressError, PortTakenError
from ai4u_edu.server.app import RoomMount, room_app
from ai4u_edu.server.desktop import open_on_desktop
from ai4u_edu.server.host_origin import LOOPBACK, hosts_for
from ai4u_edu.server.scripts import Rules
from ai4u_edu.server.serve import ServerThread, serve
from ai4u_edu.server.startup_banner import announcement
from ai4u_edu.server.token_auth import token_for, with_token
from ai4u_edu.server.viser_lockdown import shut_side_door

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
