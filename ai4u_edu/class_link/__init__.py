"""A room's side of the link to its class: dialogue, outbox and connection."""
