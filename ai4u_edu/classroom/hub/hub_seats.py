"""Seats of a hub's users. The class stores a keyed hash of the user's name, and not the name."""

import hmac
import secrets

from ai4u_edu.classroom.hub.api import HubUser
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore, SeatRow

SETTING = "hub_key"
"""Name of the setting with the key of the hashes; deleted with everything else."""


class HubSeats:
    """The seat of each user of the hub.

    A hash finds the seat again at the next sign-in. Without the key, nobody can compute it from a
    list of names; the key lies in the class's file beside it.

    Args:
        store: of the class.
        seats: of the class.
    """

    def __init__(self, store: ClassStore, seats: Seats) -> None:
        self._store, self._seats = store, seats

    def find(self, user: HubUser) -> SeatRow | None:
        """Return a user's seat; None if there is none that may enter."""
        return self._seats.by_identity(self.identity_of(user.name))

    def admit(self, user: HubUser) -> SeatRow:
        """Return a user's seat, which is made if there is none.

        Raises:
            JoinError: the seat is banned, or the class is closed or full.
        """
        return self._seats.admit(self.identity_of(user.name))

    def is_of(self, number: int, name: str) -> bool:
        """Return True if a seat is that of the user with this name."""
        seat = self._seats.by_identity(self.identity_of(name))
        return seat is not None and seat.number == number

    def identity_of(self, name: str) -> bytes:
        """Return the keyed hash of a user's name."""
        return hmac.digest(self._key(), name.encode(), "sha256")

    def _key(self) -> bytes:
        return bytes.fromhex(self._store.setting_or(SETTING, lambda: secrets.token_hex(32)))
