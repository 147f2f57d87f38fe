"""A class's store with two seats, of which one has a room."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.store import RoomRow, SeatRow, TokenRow


@contextmanager
def two_seats(folder: Path) -> Iterator[ClassStore]:
    """Opens a new store, whose seats are 1 and 2."""
    with ClassStore(folder) as store:
        for number in (1, 2):
            seat = SeatRow(number, f"Fox {number}", "#ffffff", "a", "in")
            room = RoomRow("a", "maze") if number == 1 else None
            store.add_seat(seat, TokenRow(b"%d" % number, number, f"request {number}"), room)
        yield store
