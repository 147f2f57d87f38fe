"""Keys with which students' scripts drive in their rooms, without the browser's cookie."""

import hmac
import secrets

from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore

SETTING = "script_secret"
KEY_CHARS = 24


class ScriptKeys:
    """A key for each seat, which its page shows in the Python code that drives the agent.

    Keys are computed from one secret of the class, so none is stored.

    Args:
        store: of the class.
        seats: of the class.
    """

    def __init__(self, store: ClassStore, seats: Seats) -> None:
        self._store, self._seats = store, seats

    def key_of(self, number: int) -> str:
        """Return a seat's key; empty for number 0, the teacher's."""
        if not number:
            return ""
        return hmac.digest(self._secret(), str(number).encode(), "sha256").hex()[:KEY_CHARS]

    def seat_of(self, room: str, authorization: str) -> int | None:
        """Return the number of a room's seat whose key a header has; None if there is none."""
        for seat in self._seats.all():
            if seat.room == room and seat.state == "in":
                wanted = f"Bearer {self.key_of(seat.number)}"
                if secrets.compare_digest(wanted.encode(), authorization.encode()):
                    return seat.number
        return None

    def _secret(self) -> bytes:
        return self._store.setting_or(SETTING, lambda: secrets.token_hex(16)).encode()
