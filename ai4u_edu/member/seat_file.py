"""File with the seats that this program has, so that a restart finds the same one."""

import hashlib
import json
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.member.errors import UnreachableError
from ai4u_edu.member.joining import ProgramKind, Seat, class_address, is_seat_valid, join

MAX_SEATS = 20
"""Limit of the classes whose seat is kept; the oldest one is forgotten."""


class SeatFile:
    """The latest seat in each class, by the class's address.

    The code and whatever a person typed in are not in it.

    Args:
        path: of the file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    def take(self, url: str, code: str, name_choice: int = 1, kind: ProgramKind = "play") -> Seat:
        """Return the seat that is kept, if the class still knows it; else join.

        If the class can't be reached, the kept seat is returned, too.

        Raises:
            UnreachableError: nobody answers there, and no seat is kept.
            NotJoinedError: the class gives no seat; the message says why.
        """
        kept = self.seats().get(class_address(url))
        if kept is not None:
            try:
                if is_seat_valid(kept):
                    return kept
            except UnreachableError:
                return kept
        held = kept.token if kept else ""
        seat = join(url, code, name_choice, held=held, kind=kind)
        self._keep(seat)
        return seat

    def folder(self, seat: Seat) -> Path:
        """Return the folder for a seat's files; those of another seat don't get into it."""
        digest = hashlib.sha256(f"{seat.url} {seat.token}".encode()).hexdigest()
        return self.path.parent / f"class-{digest[:16]}"

    def seats(self) -> dict[str, Seat]:
        """Return the seats by address; none if the file is damaged."""
        with suppress(OSError, ValueError, TypeError, KeyError, AttributeError):
            read: Any = json.loads(self.path.read_text(encoding="utf-8"))
            return {each["url"]: _seat(each) for each in read["seats"]}
        return {}

    def _keep(self, seat: Seat) -> None:
        others = [each for each in self.seats().values() if each.url != seat.url]
        seats = [asdict(each) for each in [*others, seat][-MAX_SEATS:]]
        with suppress(OSError):  # the next start joins anew
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(self.path, json.dumps({"seats": seats}, indent=1), mode=0o600)


def _seat(read: dict[str, Any]) -> Seat:
    seat = Seat(read["token"], read["name"], read["colour"], read["url"])
    if not all(isinstance(each, str) for each in asdict(seat).values()):
        raise TypeError(f"expected texts, got {read!r}")
    return seat
