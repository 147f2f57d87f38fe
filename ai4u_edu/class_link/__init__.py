"""A room's side of the link to its class: dialogue, outbox and connection."""

from ai4u_edu.class_link.client import LinkClient
from ai4u_edu.class_link.outbox import Outbox

__all__ = ["LinkClient", "Outbox"]
