"""Missions in a class: how far each seat is, where it is now, and who is stuck.

A student's page, or a world elsewhere, tells it; nobody proves it, as with the stars of programs.
"""

import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, ngettext, translate
from ai4u_edu.missions.mission import Mission, MissionFolder

MAX_MISSIONS = 300
"""Most missions in one report."""
MAX_NAME_CHARS = 255
MAX_HINT_CHARS = 400
MAX_COUNT = 1000
"""Largest number in a report; smaller ones are cut to what the mission has."""
MANY_HINTS = 3
"""Hints in one step from which a seat is stuck."""
LONG_MINUTES = 3.0
"""Time without progress from which a seat is stuck."""


@dataclass(frozen=True)
class Reached:
    """The progress of a seat in a mission."""

    steps: int = 0
    """Finished steps, counted from the first one."""
    stars: int = 0

    def merged(self, other: "Reached") -> "Reached":
        """Return the larger numbers of both."""
        return Reached(max(self.steps, other.steps), max(self.stars, other.stars))


@dataclass(frozen=True)
class MissionPlace:
    """The step that a seat is at."""

    mission: str
    step: int = 0
    """From 0."""
    is_done: bool = False
    """True if the step is done."""
    hint: str = ""
    """The sentence about what went wrong; empty if nothing did."""
    hints: int = 0
    """Hints in this step so far."""

    @property
    def diagnosis(self) -> str:
        """The hint as plain text, in the reader's language."""
        # the marks are those of the translation, too
        return translate(library_text(self.hint)).replace("*", "")


class ClassMissions:
    """Missions of a class, and the progress of its seats, in memory and in the class's file.

    Belongs to the event loop, except :meth:`refresh` and :meth:`save`, which threads call.

    Args:
        store: of the class.
        folder: the teacher's missions; None for those that come with the package.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(
        self,
        store: ClassStore,
        folder: Path | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._store, self._clock = store, clock
        self._folder = MissionFolder(folder)
        self.refresh()
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        self._of: dict[int, dict[str, Reached]] = defaultdict(dict)
        rows = self._store.query("select seat, mission, steps, stars from missions")
        for seat, mission, *numbers in rows:
            self._of[seat][mission] = Reached(*numbers)
        rows = self._store.query(
            "select seat, mission, step, is_done, hint, hints from mission_places"
        )
        self._places = {
            seat: MissionPlace(mission, step, bool(is_done), hint, hints)
            for seat, mission, step, is_done, hint, hints in rows
        }
        self._since = dict.fromkeys(self._places, self._clock())

    def refresh(self) -> None:
        """Read the teacher's files that were saved; a thread does it, as it may take a second."""
        self.known: Mapping[str, Mission] = self._folder.missions().by_name
        """All missions by name, in the order of the map; replaced, never changed."""

    def save(
        self, seat: int, reached: Mapping[str, Reached], place: MissionPlace | None
    ) -> tuple[dict[str, Reached], MissionPlace | None]:
        """Store what a seat has reached, which never becomes less, and where it is.

        A thread may do it. Missions that the class does not know are left out, since a file may
        have been removed, and so are numbers beyond a mission's own.

        Args:
            seat: number of the seat.
            reached: progress by mission.
            place: the present step, with an empty name if no mission is open; None to keep it.

        Returns:
            What is on disk now, to be given to :meth:`note`.

        Raises:
            StoreError: it can't be written.
        """
        self.refresh()
        known = self.known
        kept = {
            name: Reached(min(each.steps, len(mission.steps)), min(each.stars, _stars_of(mission)))
            for name, each in reached.items()
            if (mission := known.get(name)) is not None and (each.steps or each.stars)
        }
        place = None if place is None else _checked(place, known)
        with self._store.transaction() as database:
            database.executemany(
                "insert into missions values (?, ?, ?, ?) on conflict do update set "
                "steps = max(steps, excluded.steps), stars = max(stars, excluded.stars)",
                [(seat, name, each.steps, each.stars) for name, each in kept.items()],
            )
            if place is not None:
                database.execute("delete from mission_places where seat = ?", [seat])
            if place is not None and place.mission:
                database.execute(
                    "insert into mission_places values (?, ?, ?, ?, ?, ?)",
                    [seat, place.mission, place.step, place.is_done, place.hint, place.hints],
                )
        return kept, place

    def note(
        self, seat: int, reached: Mapping[str, Reached], place: MissionPlace | None = None
    ) -> bool:
        """Take over what is on disk; return True if something has changed."""
        own = self._of[seat]
        more = {name: each.merged(own.get(name, each)) for name, each in reached.items()}
        is_more = any(own.get(name) != each for name, each in more.items())
        own |= more
        before = self._places.get(seat)
        if place is not None and not place.mission:
            self._places.pop(seat, None)
        elif place is not None:
            self._places[seat] = place
            if before is None or _step(place) != _step(before):
                self._since[seat] = self._clock()
        return is_more or self._places.get(seat) != before

    def forget(self, seat: int) -> None:
        """Forget a seat that was deleted."""
        for part in (self._of, self._places, self._since):
            part.pop(seat, None)

    def arrived(self, seat: int) -> None:
        """Note that a seat has come (back): its time at a step counts from now."""
        self._since[seat] = self._clock()

    def of_seat(self, seat: int) -> dict[str, Reached]:
        """Return what a seat has reached, by mission."""
        return dict(self._of.get(seat, {}))

    def by_seat(self) -> dict[str, dict[str, list[int]]]:
        """Return steps and stars of all seats by mission, as the teacher's page gets them."""
        return {
            str(seat): {name: [each.steps, each.stars] for name, each in reached.items()}
            for seat, reached in self._of.items()
            if reached
        }

    def catalogue(self) -> list[dict[str, Any]]:
        """Return all missions as the teacher's page gets them."""
        return [
            {
                "name": name,
                "title": library_text(mission.title),
                "island": mission.island,
                "steps": len(mission.steps),
                "stars": _stars_of(mission),
            }
            for name, mission in self.known.items()
        ]

    def places(self) -> dict[str, dict[str, Any]]:
        """Return where all seats are, as the teacher's page gets it."""
        known = self.known
        return {
            str(seat): {
                "mission": place.mission,
                "title": library_text(known[place.mission].title),
                "step": place.step,
                "steps": len(known[place.mission].steps),
                "is_done": place.is_done,
                "hint": place.diagnosis,
                "minutes": int(self._minutes(seat)),
            }
            for seat, place in self._places.items()
            if place.mission in known
        }

    def counts(self, seats: Iterable[int]) -> list[dict[str, Any]]:
        """Return how many seats are in each mission, and how many of them are stuck.

        Args:
            seats: numbers of those who count.
        """
        here = [seat for seat in seats if seat in self._places]
        present = Counter(self._places[seat].mission for seat in here)
        stuck = Counter(self._places[seat].mission for seat in here if self.stuck(seat)[0])
        return [
            {"title": library_text(mission.title), "count": present[name], "stuck": stuck[name]}
            for name, mission in self.known.items()
            if present[name]
        ]

    def stuck(self, seat: int) -> tuple[int, str]:
        """Return how much a seat needs help in its mission (0 to 100), and the reason in words.

        The higher one counts:

        ===================================  ===============================
        n >= 3 hints in one step             40 + 10 (n - 3), at most 80
        m >= 3 minutes without progress      35 + 5 (m - 3), at most 70
        ===================================  ===============================
        """
        place = self._places.get(seat)
        mission = None if place is None else self.known.get(place.mission)
        if place is None or mission is None or place.is_done:
            return 0, ""
        minutes, score = self._minutes(seat), 0.0
        if place.hints >= MANY_HINTS:
            score = min(80, 40 + 10 * (place.hints - MANY_HINTS))
        if minutes >= LONG_MINUTES:
            score = max(score, min(70, 35 + 5 * (minutes - LONG_MINUTES)))
        if not score:
            return 0, ""
        step, title = place.step + 1, library_text(mission.title)
        where: str = _("step {step} of “{mission}”", step=step, mission=title)
        if minutes >= 2:
            where = ngettext(
                "step {step} of “{mission}” for {n} minute",
                "step {step} of “{mission}” for {n} minutes",
                int(minutes),
                step=step,
                mission=title,
            )
        # a card shows the first words only, and the mission below them
        if not place.hint:
            return int(score), where
        return int(score), _("{problem} ({where})", problem=place.diagnosis, where=where)

    def _minutes(self, seat: int) -> float:
        return (self._clock() - self._since.get(seat, self._clock())) / 60


def _stars_of(mission: Mission) -> int:
    return 1 + len(mission.stars)


def _step(place: MissionPlace) -> tuple[str, int, bool]:
    return place.mission, place.step, place.is_done


def _checked(place: MissionPlace, known: Mapping[str, Mission]) -> MissionPlace:
    """Return a place in a mission that the class knows, with a hint that the step has."""
    mission = known.get(place.mission)
    if mission is None:
        return MissionPlace("")
    step = min(place.step, len(mission.steps) - 1)
    # the teacher reads hints: no other words of a page reach the wall this way
    is_own = any(hint.say == place.hint for hint in mission.steps[step].hints)
    return replace(place, step=step, hint=place.hint if is_own else "")
