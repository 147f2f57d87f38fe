"""State of a class that the pages of one of its worlds show."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from msgspec.structs import asdict

from ai4u_edu.wire.class_link import Attention, CurrentRace, LinkWelcome, People, Person, Switches

TEACHER = "teacher"
STUDENT = "student"
NO_SWITCHES = Switches()


@dataclass(frozen=True)
class _ViewState:
    """State of a view; replaced, never changed."""

    name: str = ""
    colour: str = ""
    people: tuple[Person, ...] = ()
    has_teacher: bool = False
    attention: Attention | None = None
    attention_ends_at: float | None = None
    switches: Switches = NO_SWITCHES
    race: CurrentRace | None = None
    race_starts_at: float = 0.0
    own_best: float | None = None
    lesson: str = ""
    program: str = ""
    program_scene: str = ""
    mission: str = ""
    assignment: str = ""


class ClassView:
    """The state of a class as a world knows it. Any thread may write and read it.

    Args:
        clock: seconds.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._shown: _ViewState | None = None
        self._version = 0

    @property
    def version(self) -> int:
        """A number that grows with every change; 0 while the class has sent nothing."""
        return self._version

    def welcome(self, message: LinkWelcome) -> None:
        """Show whose world it is."""
        self._change(name=message.name, colour=message.colour)

    def set_people(self, message: People) -> None:
        """Show who else has this world, and whether the teacher looks in."""
        self._change(people=message.people, has_teacher=message.has_teacher)

    def set_lesson(self, lesson: str) -> None:
        """Show the lesson that the class is at; empty for none."""
        self._change(lesson=lesson)

    def set_program(self, source: str, scene: str) -> None:
        """Offer a program to begin with.

        Args:
            source: in Python; empty for none.
            scene: name of the scene that it is for; empty for any.
        """
        self._change(program=source, program_scene=scene)

    def set_mission(self, mission: str, assignment: str) -> None:
        """Have pages open a mission, once for each assignment.

        Args:
            mission: its name; empty for none.
            assignment: id of the assignment.
        """
        self._change(mission=mission, assignment=assignment)

    def set_attention(self, message: Attention | None, ends_at: float | None = None) -> None:
        """Show the teacher's message.

        Args:
            message: None for its end.
            ends_at: time of the clock (s) at which it ends by itself.
        """
        self._change(attention=message, attention_ends_at=ends_at)

    def set_switches(self, switches: Switches) -> None:
        """Show what the teacher has turned on for the whole class."""
        self._change(switches=switches)

    def set_race(self, race: CurrentRace | None, starts_at: float, own_best: float | None) -> None:
        """Show a race.

        Args:
            race: None for none.
            starts_at: time of the clock (s).
            own_best: shortest time (s) of this world to the goal.
        """
        self._change(race=race, race_starts_at=starts_at, own_best=own_best)

    def event(self, role: str, seat: int) -> dict[str, Any] | None:
        """Return the event for a page; None while the class has sent nothing.

        Args:
            role: ``teacher`` or ``student``.
            seat: number of the page's seat; 0 if it is not known.
        """
        shown = self._shown
        if shown is None:
            return None
        own = next((each for each in shown.people if each.number == seat), None)
        is_teacher = role == TEACHER
        return {
            "type": "class",
            "name": own.name if own else "" if is_teacher else shown.name,
            "colour": own.colour if own else "" if is_teacher else shown.colour,
            "role": TEACHER if is_teacher else STUDENT,
            "people": [
                {
                    "number": each.number,
                    "name": each.name,
                    "colour": each.colour,
                    "is_here": each.is_here,
                }
                for each in shown.people
            ],
            "has_teacher": shown.has_teacher and not is_teacher,
            "attention": {
                "kind": shown.attention.kind if shown.attention else "",
                "message": shown.attention.message if shown.attention else "",
                "ends_in": self._left(shown.attention_ends_at),
            },
            "switches": asdict(shown.switches),
            "race": self._race(shown),
            "lesson": shown.lesson,
            "program": (
                {"scene": shown.program_scene, "source": shown.program} if shown.program else None
            ),
            "mission": {"mission": shown.mission, "assignment": shown.assignment},
        }

    def _race(self, shown: _ViewState) -> dict[str, Any] | None:
        race = shown.race
        if race is None:
            return None
        starts_in = self._left(shown.race_starts_at)
        is_counting = race.phase == "countdown" and starts_in > 0
        return {
            "id": race.id,
            "phase": race.phase if race.phase == "over" or is_counting else "running",
            "starts_in": starts_in,
            "board": [
                {
                    "name": row.name,
                    "colour": row.colour,
                    "outcome": row.outcome,
                    "seconds": row.seconds,
                }
                for row in race.board
            ],
            "own_best": shown.own_best,
        }

    def _left(self, until: float | None) -> float:
        return 0.0 if until is None else round(max(0.0, until - self._clock()), 2)

    def _change(self, **fields: Any) -> None:
        with self._lock:
            values = {**vars(self._shown or _ViewState()), **fields}
            shown = _ViewState(**values)
            if shown != self._shown:
                self._shown = shown
                self._version += 1
