"""The rooms of a class that runs none itself."""

from contextlib import AbstractContextManager, nullcontext

from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.room_host import RoomAddress


class NoRooms:
    """A host without rooms: all worlds are students' own, and keep links to the class."""

    is_hosting = False

    async def enter(self, room: str, scene: str) -> RoomAddress:
        """Refuse to start a room."""
        raise RoomError(f"expected a world on the student's own server, got {room!r}, {scene!r}")

    def in_use(self, room: str) -> AbstractContextManager[None]:  # noqa: ARG002
        """Do nothing."""
        return nullcontext()

    def room_of(self, secret: str) -> str:  # noqa: ARG002
        """Return that no room has this secret."""
        return ""

    def is_used(self, room: str) -> bool:  # noqa: ARG002
        """Return False."""
        return False

    def is_running(self, room: str) -> bool:  # noqa: ARG002
        """Return False."""
        return False

    async def end(self, room: str) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""
