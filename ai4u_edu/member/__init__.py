"""A room's and a notebook's side of their class: joining, the link, and what a world reports."""

from ai4u_edu.member.class_view import ClassView
from ai4u_edu.member.client import LinkClient
from ai4u_edu.member.joining import (
    NotJoinedError,
    Seat,
    SeatFile,
    UnreachableError,
    is_at_hub,
    join,
    join_at_hub,
    page_at_hub,
)
from ai4u_edu.member.link import ClassLink, ClassLinkSettings, LinkTimeouts, Receive
from ai4u_edu.member.member import ClassMember
from ai4u_edu.member.outbox import ResultOutbox

__all__ = [
    "ClassLink",
    "ClassLinkSettings",
    "ClassMember",
    "ClassView",
    "LinkClient",
    "LinkTimeouts",
    "NotJoinedError",
    "Receive",
    "ResultOutbox",
    "Seat",
    "SeatFile",
    "UnreachableError",
    "is_at_hub",
    "join",
    "join_at_hub",
    "page_at_hub",
]
