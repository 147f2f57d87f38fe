"""Rule for the rooms of new seats."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom.store import SeatRow

MAX_SEATS = 200
PAIR = 2


@dataclass(frozen=True)
class RoomRule:
    """Rule for the rooms of new seats: ``each``, ``pairs``, ``teams:N`` or ``one``.

    >>> RoomRule.parse("teams:4")
    RoomRule(kind='teams', count=4)
    """

    kind: str = "each"
    count: int = 0

    @classmethod
    def parse(cls, text: str) -> "RoomRule":
        """Return the rule in a text.

        Raises:
            SetupError: it is none.
        """
        kind, _, number = text.partition(":")
        if kind == "teams" and number.isdecimal() and 1 <= int(number) <= MAX_SEATS:
            return cls(kind, int(number))
        if kind in ("each", "pairs", "one") and not number:
            return cls(kind)
        raise SetupError(f"--rooms: expected each, pairs, teams:N or one, got {text!r}")

    def room_for(self, seats: Iterable[SeatRow]) -> str:
        """Return the room that a new seat shares; empty for a room of its own."""
        members = Counter(each.room for each in seats)
        if self.kind == "one" and members:
            return next(iter(members))
        if self.kind == "pairs":
            return next((room for room, count in members.items() if count < PAIR), "")
        if self.kind == "teams" and len(members) >= self.count:
            return min(members, key=members.__getitem__)
        return ""
