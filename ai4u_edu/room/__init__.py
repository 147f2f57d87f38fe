"""One room: a running world with its page and API, as ``ai4u-edu play`` serves it."""

from ai4u_edu.room.room import Room
from ai4u_edu.room.served_world import ServedWorld, serve_world
from ai4u_edu.room.settings import RoomSettings

__all__ = ["Room", "RoomSettings", "ServedWorld", "serve_world"]
