"""The connection to viser: broadcast, incoming messages, pace of drawing."""
