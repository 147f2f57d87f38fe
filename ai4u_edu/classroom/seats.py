"""Seats of a class: who may enter which room. A seat is no account and names nobody."""

import hashlib
import secrets
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from enum import Enum
from threading import Lock

from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom.errors import (
    JoinError,
    NameTakenError,
    NewSeatError,
    StoreError,
    WrongCodeError,
)
from ai4u_edu.classroom.names import (
    DEFAULT_LANGUAGE,
    LANGUAGES,
    MoveCodes,
    colour_of,
    free_names,
    is_name,
    new_code,
    normalized_code,
)
from ai4u_edu.classroom.store import ClassStore, RoomRow, SeatRow, TokenRow
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.joining import SEAT_COOKIE

MAX_SEATS = 200
OFFERED_NAMES = 3
ROOM_ID_BYTES = 6
MAX_DEVICES = 3
"""Devices that hold a seat at the same time; one more takes the place of the oldest."""
UNOPENED_S = 60.0
"""Time that a new seat has to open its room, before it makes room for another one in a full class.
"""
COOKIE_SETTING = "seat_cookie"
"""Name of the setting with the name of the seats' cookie."""


class SeatState(Enum):
    """State of a seat."""

    IN = "in"
    LEFT = "left"
    KICKED = "kicked"
    BANNED = "banned"


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
        kind, _colon, number = text.partition(":")
        if kind == "teams" and number.isdecimal() and 1 <= int(number) <= MAX_SEATS:
            return cls(kind, int(number))
        if kind in ("each", "pairs", "one") and not number:
            return cls(kind)
        raise SetupError(
            _("--rooms: expected each, pairs, teams:N or one, got {text!r}", text=text)
        )

    def room_for(self, seats: Iterable[SeatRow]) -> str:
        """Return the room that a new seat shares; empty for a room of its own."""
        members = Counter(each.room for each in seats)
        if self.kind == "one" and members:
            return next(iter(members))
        if self.kind == "pairs":
            return next((room for room, count in members.items() if count < 2), "")
        if self.kind == "teams" and len(members) >= self.count:
            return min(members, key=members.__getitem__)
        return ""


class Seats:
    """All seats of a class, in memory and in its file. Thread-safe.

    Args:
        store: of the class.
        scene: of new rooms.
        rooms: rule for the rooms of new seats.
        code: join code; default: the stored one or a new one.
        language: of the names that are offered.
        clock: returns seconds; to be replaced in tests.

    Raises:
        SetupError: there are no names in that language.
    """

    def __init__(
        self,
        store: ClassStore,
        scene: str,
        rooms: RoomRule,
        code: str = "",
        language: str = DEFAULT_LANGUAGE,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        if language not in LANGUAGES:
            known = ", ".join(LANGUAGES)
            raise SetupError(
                _(
                    "language: expected one of {known}, got {language!r}",
                    known=known,
                    language=language,
                )
            )
        self._store, self._scene, self._rooms = store, scene, rooms
        self._language, self._clock = language, clock
        self._made_at: dict[int, float] = {}
        """Times at which seats were made, by number; of this run."""
        self._lock = Lock()
        self._move_codes = MoveCodes()
        self._seats: dict[int, SeatRow] = {}
        self._tokens: dict[bytes, TokenRow] = {}
        self._scenes: dict[str, str] = {}
        self._read()
        self.code = normalized_code(code) or store.setting("code") or new_code()
        store.set_setting("code", self.code)
        self.is_open = store.setting("open", "yes") == "yes"
        """False while nobody else may join."""

    def __len__(self) -> int:
        return len(self._seats)

    def all(self) -> list[SeatRow]:
        """Return all seats, by number."""
        with self._lock:
            return list(self._seats.values())

    def scenes(self) -> dict[str, str]:
        """Return the scene of each room."""
        with self._lock:
            return dict(self._scenes)

    def offered_names(self) -> list[str]:
        """Return names to choose from."""
        with self._lock:
            return free_names(
                {each.name for each in self._seats.values()}, OFFERED_NAMES, self._language
            )

    @property
    def cookie(self) -> str:
        """Name of the cookie with a seat's token: each class has one, as cookies know no ports."""
        return self._cookie

    def join(
        self, code: str, name: str, request: str, held: str = "", *, may_be_new: bool = True
    ) -> tuple[SeatRow, str]:
        """Give somebody a seat, and return it with its secret token.

        Repeated with the same request id, because an answer was lost or the seat was sent out, it
        gives the same seat; the token is then a new one, and the one before is void.

        Args:
            code: as it was typed in.
            name: one of those that were offered.
            request: random id of the request, which the browser makes.
            held: token that the browser has already; a banned seat's gets no other one.
            may_be_new: False if a seat that is there already will do, and no other one.

        Raises:
            WrongCodeError: the code is not the class's.
            NewSeatError: this would be a new seat.
            NameTakenError: somebody else has that name.
            JoinError: the class is full or closed, or the seat is banned.
        """
        token, wanted = secrets.token_urlsafe(24), normalized_code(code)
        request = digest_of(request)
        with self._lock:
            moved, is_teachers = self._move_codes.use(wanted, request)
            if not moved and not secrets.compare_digest(wanted.encode(), self.code.encode()):
                raise WrongCodeError(_("This code is not right. Look at the board again."))
            replaced = [each for each in self._tokens.values() if _is_of(each, request, held)]
            own = [self._seats[each.seat] for each in replaced]
            if moved:
                own = [self._seats[moved]]
            if not is_teachers:  # with the teacher's code, the teacher has decided
                if any(each.state == SeatState.BANNED.value for each in own):
                    raise JoinError(_("You may not join this class. Ask your teacher."))
                if any(each.state != SeatState.IN.value for each in own) or not own:
                    self._check_open()
            if own:
                seat = self._take_again(own[0], request, token, replaced)
            else:
                self._check_name(name)
                if not may_be_new:
                    raise NewSeatError("expected a seat that is there already")
                seat = self._new_seat(name, TokenRow(hash_of(token), 0, request))
        return seat, token

    def _take_again(
        self, seat: SeatRow, request: str, token: str, replaced: list[TokenRow]
    ) -> SeatRow:
        """Store another device of a seat, in the place of its own token before, and return it."""
        before = [each for each in self._tokens.values() if each.seat == seat.number]
        if seat.state != SeatState.IN.value:  # whoever was sent out with it stays out
            before = []
            self._make_room()
        kept = [each for each in before if each not in replaced][-(MAX_DEVICES - 1) :]
        tokens = [*kept, TokenRow(hash_of(token), seat.number, request)]
        # its own seat before may have made room just now
        others = [
            each for each in replaced if each.seat != seat.number and each.seat in self._seats
        ]
        seat = replace(seat, state=SeatState.IN.value)
        for each in others:  # a device that moves to another seat leaves its own
            left = self._seats[each.seat]
            self._store.update_seat(left, [one for one in self._of(left) if one != each])
        self._store.update_seat(seat, tokens)
        gone = {each.hash for each in [*others, *self._of(seat)]}
        self._tokens = {key: each for key, each in self._tokens.items() if key not in gone}
        self._tokens |= {each.hash: each for each in tokens}
        self._seats[seat.number] = seat
        return seat

    def _of(self, seat: SeatRow) -> list[TokenRow]:
        return [each for each in self._tokens.values() if each.seat == seat.number]

    def _check_open(self) -> None:
        if not self.is_open:
            raise JoinError(_("Nobody else can join at present. Ask your teacher."))

    def _new_seat(self, name: str, device: TokenRow) -> SeatRow:
        """Store a new seat with its device, whose number is set here, and return it."""
        self._store.quota.check()
        self._make_room()
        number = max(self._seats, default=0) + 1
        room = self._rooms.room_for(list(self._seats.values()))
        new_room = None
        if not room:
            room = secrets.token_hex(ROOM_ID_BYTES)
            new_room = RoomRow(room, self._scene)
        seat = SeatRow(number, name, colour_of(number), room, SeatState.IN.value)
        device = replace(device, seat=number)
        self._store.add_seat(seat, device, new_room)
        if new_room is not None:
            self._scenes[room] = self._scene
        self._seats[number], self._tokens[device.hash] = seat, device
        self._made_at[number] = self._clock()
        return seat

    def _check_name(self, name: str) -> None:
        if not is_name(name):
            raise JoinError(_("Choose one of the names that are offered."))
        if name in {each.name for each in self._seats.values()}:
            raise NameTakenError(_taken(name))

    def _make_room(self) -> None:
        """In a full class, take back the oldest seat that never opened its room.

        Those who were sent out or banned don't count: their seats are kept with their work.

        Raises:
            JoinError: there is no such seat.
        """
        taken = [each for each in self._seats.values() if each.state == SeatState.IN.value]
        if len(taken) < MAX_SEATS:
            return
        before = self._clock() - UNOPENED_S
        for seat in taken:
            is_old = self._made_at.get(seat.number, before) <= before
            if not seat.is_opened and is_old and self._store.remove_unused_seat(seat):
                self._forget_seat(seat)
                return
        raise JoinError(
            _("The class is full: it has {seats} seats. Ask your teacher.", seats=MAX_SEATS)
        )

    def _forget_seat(self, seat: SeatRow) -> None:
        del self._seats[seat.number]
        self._made_at.pop(seat.number, None)
        self._tokens = {key: each for key, each in self._tokens.items() if each.seat != seat.number}
        if seat.room not in {each.room for each in self._seats.values()}:
            self._scenes.pop(seat.room, None)

    def has_opened(self, number: int) -> bool:
        """Return True if a seat has opened its room."""
        with self._lock:
            seat = self._seats.get(number)
        return seat is not None and seat.is_opened

    def note_opened(self, number: int) -> None:
        """Store that a seat has opened its room, or has brought one along."""
        with self._lock:
            seat = self._seats.get(number)
            if seat is None or seat.is_opened:
                return
            opened = replace(seat, is_opened=True)
            with suppress(StoreError):  # it is tried again with the next request
                self._store.update_seat(opened)
                self._seats[number] = opened

    def by_token(self, token: str) -> SeatRow | None:
        """Return the seat whose token this is; None if there is none that may enter."""
        with self._lock:
            # tokens are found by their digest, so the time that it takes tells nothing of them
            device = self._tokens.get(hash_of(token))
            seat = None if device is None else self._seats[device.seat]
        return seat if seat is not None and seat.state == SeatState.IN.value else None

    def by_identity(self, identity: bytes) -> SeatRow | None:
        """Return the seat of a person; None if there is none that may enter; see :meth:`admit`."""
        with self._lock:
            device = self._tokens.get(identity)
            seat = None if device is None else self._seats[device.seat]
        return seat if seat is not None and seat.state == SeatState.IN.value else None

    def admit(self, identity: bytes) -> SeatRow:
        """Return the seat of a person whom another system has identified; a new one if needed.

        Args:
            identity: a hash of what that system calls the person.

        Raises:
            JoinError: the class is full or closed, the seat is banned, or no name is left.
        """
        with self._lock:
            device = self._tokens.get(identity)
            if device is None:
                self._check_open()
                taken = {each.name for each in self._seats.values()}
                names = free_names(taken, 1, self._language)
                if not names:
                    raise JoinError(_("The class has no name left. Ask your teacher."))
                return self._new_seat(names[0], TokenRow(identity, 0, identity.hex()))
            seat = self._seats[device.seat]
            if seat.state == SeatState.BANNED.value:
                raise JoinError(_("You may not join this class. Ask your teacher."))
            if seat.state != SeatState.IN.value:
                self._check_open()
                seat = replace(seat, state=SeatState.IN.value)
                self._store.update_seat(seat)
                self._seats[seat.number] = seat
            return seat

    def new_move_code(self, number: int, *, is_teachers: bool = False) -> str:
        """Return a code with which a seat moves to another device; see :mod:`.move_codes`.

        Args:
            number: of the seat.
            is_teachers: True for a code from the teacher, with which a seat that was sent out or
                banned comes back, also to a class that is closed.

        Raises:
            JoinError: there is no such seat.
        """
        with self._lock:
            self._known(number)
            return self._move_codes.new(number, {self.code}, is_teachers=is_teachers)

    def has_move_code(self, number: int) -> bool:
        """Return True while a code of a seat can be used; see :meth:`new_move_code`."""
        with self._lock:
            return self._move_codes.is_open(number)

    def delete(self, number: int, rooms: Collection[str]) -> None:
        """Delete a seat with its work, and rooms that nobody else has; a thread may do it.

        Raises:
            JoinError: there is no such seat.
            StoreError: it can't be deleted; then nothing has changed.
        """
        with self._lock:
            seat = self._known(number)
            self._store.delete_seat(seat, rooms)
            self._move_codes.cancel(number)
            self._forget_seat(seat)

    def set_state(self, number: int, state: SeatState) -> None:
        """Store that somebody left, was kicked (and may join again) or banned.

        Raises:
            JoinError: there is no such seat.
        """
        with self._lock:
            seat = replace(self._known(number), state=state.value)
            self._store.update_seat(seat)
            self._seats[number] = seat

    def rename(self, number: int, name: str) -> None:
        """Give a seat another name of the lists.

        Raises:
            JoinError: there is no such seat, or the name is none of the lists.
            NameTakenError: somebody else has that name.
        """
        with self._lock:
            seat = self._known(number)
            if not is_name(name):
                raise JoinError(_("expected a name of the lists, got {name!r}", name=name[:40]))
            if name in {each.name for each in self._seats.values() if each.number != number}:
                raise NameTakenError(_taken(name))
            seat = replace(seat, name=name)
            self._store.update_seat(seat)
            self._seats[number] = seat

    def change_code(self) -> str:
        """Set a new code, and return it; seats stay."""
        with self._lock:
            code = new_code()
            self._store.set_setting("code", code)  # first: a full disk leaves the old one
            self.code = code
            return code

    def set_open(self, is_open: bool) -> None:
        """Let others join, or nobody else."""
        with self._lock:
            self._store.set_setting("open", "yes" if is_open else "no")
            self.is_open = is_open

    def let_nobody_in(self) -> None:
        """Forget all seats and rooms in memory, and close the class; its file is left as it is."""
        with self._lock:
            self._seats, self._tokens, self._scenes, self._made_at = {}, {}, {}, {}
            self.is_open = False

    def begin_anew(self) -> None:
        """Delete the class's file with all seats and rooms, begin another one, set a new code.

        The rule of rooms and their scene stay.

        Raises:
            StoreError: it can't be deleted.
        """
        with self._lock:
            self._store.begin_anew()
            self._move_codes.clear()
            self._read()
            self.is_open = True
        self.change_code()

    def _read(self) -> None:
        self._seats = {each.number: each for each in self._store.seats()}
        self._tokens = {each.hash: each for each in self._store.tokens()}
        self._scenes = {each.id: each.scene for each in self._store.rooms()}
        self._made_at = {}
        name = self._store.setting_or(COOKIE_SETTING, lambda: secrets.token_hex(4))
        self._cookie = f"{SEAT_COOKIE}_{name}"

    def _known(self, number: int) -> SeatRow:
        if number not in self._seats:
            raise JoinError(_("there is no seat {number}", number=number))
        return self._seats[number]


def _taken(name: str) -> Text:
    return _("Somebody else is {name} already. Choose another name.", name=name)


def _is_of(device: TokenRow, request: str, held: str) -> bool:
    """Return True if a browser with this request id or token had the seat."""
    is_held = bool(held) and secrets.compare_digest(device.hash, hash_of(held))
    return device.request == request or is_held


def digest_of(request: str) -> str:
    """Return what is stored of a join request's id: with the id and the code one gets its seat."""
    return hashlib.sha256(b"ai4u-edu request " + request.encode()).hexdigest()


def hash_of(token: str) -> bytes:
    """Return what is stored of a token. It is random, so a plain digest is enough."""
    return hashlib.sha256(b"ai4u-edu seat " + token.encode()).digest()
