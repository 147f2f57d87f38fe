"""Interface of what runs the rooms of a class: processes here, or another engine."""

from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class RoomAddress:
    """Address of a room's server, with its secret."""

    host: str
    port: int
    token: str
    """Secret of the server, and of viser."""
    viser_port: int | None = None
    """Port of the room's viser, if it is on this machine: pages' sockets need not pass through the
    room's server then."""


class RoomHost(Protocol):
    """Runs rooms. Its methods belong to the event loop of the class."""

    @property
    def is_hosting(self) -> bool:
        """True if seats have rooms here; False if all worlds are students' own."""

    async def enter(self, room: str, scene: str) -> RoomAddress:
        """Return the address of a room's server, which is started if it does not run.

        Raises:
            RoomError: it does not start.
        """

    def in_use(self, room: str) -> AbstractContextManager[None]:
        """Keep a room's server running while a socket of it is open."""

    def room_of(self, secret: str) -> str:
        """Return the room whose secret this is, also while it starts; empty if it is no room's."""

    def is_used(self, room: str) -> bool:
        """Return True while a socket of the room is open."""

    def is_running(self, room: str) -> bool:
        """Return True if the room's server runs."""

    async def end(self, room: str) -> None:
        """End a room's server; what was made there is saved."""

    def close(self) -> None:
        """End all servers, when the class's event loop has ended."""
