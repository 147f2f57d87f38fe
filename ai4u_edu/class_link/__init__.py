"""A room's side of the link to its class: joining, dialogue, outbox and connection."""

from ai4u_edu.class_link.client import LinkClient
from ai4u_edu.class_link.errors import NotJoinedError, UnreachableError
from ai4u_edu.class_link.hub import is_at_hub, join_at_hub, page_at_hub
from ai4u_edu.class_link.joining import Seat, join
from ai4u_edu.class_link.outbox import Outbox
from ai4u_edu.class_link.seat_file import SeatFile
from ai4u_edu.class_link.timeouts import LinkTimeouts

__all__ = [
    "LinkClient",
    "LinkTimeouts",
    "NotJoinedError",
    "Outbox",
    "Seat",
    "SeatFile",
    "UnreachableError",
    "is_at_hub",
    "join",
    "join_at_hub",
    "page_at_hub",
]
