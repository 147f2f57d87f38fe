"""The web server: one port for page, viser, keys, scripts and API."""

from ai4u_edu.page.server.address import AddressError, PortTakenError
from ai4u_edu.page.server.app import RoomMount, room_app
from ai4u_edu.page.server.host_origin import LOOPBACK, hosts_for, is_loopback
from ai4u_edu.page.server.limits.timeouts import Timeouts
from ai4u_edu.page.server.scripts import Rules
from ai4u_edu.page.server.serve import ServerThread, serve
from ai4u_edu.page.server.start_page import MissionsView
from ai4u_edu.page.server.startup_banner import open_on_desktop, startup_banner
from ai4u_edu.page.server.token_auth import token_for, with_token
from ai4u_edu.page.server.viser_lockdown import lock_viser_port

__all__ = [
    "LOOPBACK",
    "AddressError",
    "MissionsView",
    "PortTakenError",
    "RoomMount",
    "Rules",
    "ServerThread",
    "Timeouts",
    "hosts_for",
    "is_loopback",
    "lock_viser_port",
    "open_on_desktop",
    "room_app",
    "serve",
    "startup_banner",
    "token_for",
    "with_token",
]
