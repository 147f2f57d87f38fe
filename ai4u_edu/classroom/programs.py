"""Programs that students write in their pages, their latest runs, and the stars that they earned.

A program is text. Nothing of the class reads it as Python: it runs in the student's browser only.
A student's page tells runs and stars, as a notebook tells the results of exercises; nobody proves
them.
"""

import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from ai4u_edu.classroom.errors import NewerProgramError, ProgramNotKeptError
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.star_goals import library_star_counts

MAX_PROGRAM_CHARS = 100_000
MAX_PROGRAMS = 50
"""Limit of a seat's programs."""
MAX_SCENE_NAME_CHARS = 200
MAX_AGENT_NAME_CHARS = 100
FOLDER = "programs"
"""Folder of programs in ZIP files with the work of a class."""
MAX_DEVICE_CHARS = 64
_ALL = "select seat, scene, agent, source, version, device, saved_at from programs"
_OF_SEAT = _ALL + " where seat = ?"
_NOT_DELETED = " and source != ''"
_LATEST_FIRST = " order by version desc"


@dataclass(frozen=True)
class ProgramRow:
    """A program, as it is stored."""

    seat: int
    scene: str
    agent: str
    """Id of the agent that it drives; behind a slash the program's name, if it has got one."""
    source: str
    """The text; empty once the student has deleted the program."""
    version: int
    """Number of the save, counted over all programs of the class; a later one is greater."""
    device: str
    """Random id of the browser that saved it."""
    saved_at: float
    """Time by this machine's clock (s since 1970), to be shown to people; it decides nothing."""


class Programs:
    """The programs of each seat, scene and agent. Thread-safe, as the class's file is.

    Args:
        store: of the class.
        clock: returns seconds since 1970; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.time) -> None:
        self._store, self._clock = store, clock

    def save(
        self, seat: int, scene: str, agent: str, source: str, *, base: int, device: str
    ) -> int:
        """Store a seat's program, unless another device has stored one that this one never saw.

        Saves are counted, as clocks differ between devices and may be set at any time.

        Args:
            seat: number of the seat.
            scene: name of the scene.
            agent: id of the agent.
            source: the program.
            base: latest version that the device has seen; 0 for none.
            device: id of the browser.

        Returns:
            The version, which is on disk.

        Raises:
            NewerProgramError: another device has stored a later version.
            ProgramNotKeptError: the seat has too many programs.
            StoreError: it can't be written.
        """
        with self._store.transaction() as database:
            stored = database.execute(
                "select version, device from programs where seat = ? and scene = ? and agent = ?",
                [seat, scene, agent],
            ).fetchone()
            if stored is not None and stored[0] > base and stored[1] != device:
                raise NewerProgramError(_("The class has a newer program, from another device."))
            (count,) = database.execute(
                "select count(*) from programs where seat = ?", [seat]
            ).fetchone()
            if stored is None and count >= MAX_PROGRAMS:
                raise ProgramNotKeptError(
                    _(
                        "The class keeps at most {number} programs of each student, and you have "
                        "that many. This one stays in this browser; download it.",
                        number=MAX_PROGRAMS,
                    )
                )
            version: int = database.execute(
                "insert or replace into programs values (?, ?, ?, ?, "
                "(select coalesce(max(version), 0) + 1 from programs), ?, ?) returning version",
                [seat, scene, agent, source, device, self._clock()],
            ).fetchone()[0]
        return version

    def find(self, seat: int, scene: str, agent: str) -> ProgramRow | None:
        """Return a seat's program; None if there is none."""
        values = [seat, scene, agent]
        rows = self._store.query(_OF_SEAT + " and scene = ? and agent = ?", values)
        return ProgramRow(*rows[0]) if rows else None

    def of_seat(self, seat: int) -> list[ProgramRow]:
        """Return a seat's programs, the one that was saved last first."""
        rows = self._store.query(_OF_SEAT + _LATEST_FIRST, [seat])
        return [ProgramRow(*row) for row in rows]

    def agents_of(self, seat: int, scene: str) -> list[str]:
        """Return the agents of a seat's programs in a scene, the one that was saved last first."""
        rows = self.of_seat(seat)
        return [row.agent for row in rows if row.scene == scene and row.source]

    def latest_of(self, seat: int) -> ProgramRow | None:
        """Return the program of a seat that was saved last; None if there is none."""
        rows = self._store.query(_OF_SEAT + _NOT_DELETED + _LATEST_FIRST + " limit 1", [seat])
        return ProgramRow(*rows[0]) if rows else None

    def latest_of_all(self) -> list[ProgramRow]:
        """Return the program of each seat that was saved last, the latest first."""
        of_each = (
            " where version in (select max(version) from programs where source != '' group by seat)"
        )
        return [ProgramRow(*row) for row in self._store.query(_ALL + of_each + _LATEST_FIRST)]

    def age_of(self, program: ProgramRow) -> float:
        """Return the seconds since a program was saved, by a clock that may have been set since."""
        return max(0.0, self._clock() - program.saved_at)


RunState = Literal["running", "mistake", "ended"]
MistakeKind = Literal[
    "syntax",
    "indentation",
    "entry",
    "parameters",
    "no-return",
    "action",
    "actuator",
    "length",
    "not-a-number",
    "not-finite",
    "wrong-key",
    "unknown-name",
    "attribute",
    "endless",
    "recursion",
    "memory",
    "numpy",
    "import",
    "error",
]
"""Kinds of :class:`~ai4u_edu.program.mistakes.ProgramError`."""
_OTHER = (_("Python stopped"), _("Read the last words of the sentence aloud: which word is new?"))
_WORDS: dict[str, tuple[str, str]] = {
    "syntax": (
        _("Python can't read a line"),
        _("Read the line aloud, with every sign. Which one is missing, or too many?"),
    ),
    "indentation": (
        _("Spaces at the beginning of a line"),
        _("What belongs together begins at the same place: four spaces after each colon."),
    ),
    "entry": (_("decide(percept) is missing"), _("The robot calls `decide` by its name.")),
    "parameters": (
        _("The brackets of a function do not fit its call"),
        _("Count what stands in the brackets after `def`, and in the call."),
    ),
    "no-return": (
        _("Nothing is returned"),
        _("Follow the program with a finger: is there a way past every `return`?"),
    ),
    "action": (
        _("The action has another form"),
        _("Look at “It can do”: a name, and a list of numbers."),
    ),
    "actuator": (_("There is no such actuator"), _("Compare the name with the list “It can do”.")),
    "length": (_("Too many or too few numbers"), _("Count the numbers in the list “It can do”.")),
    "not-a-number": (_("A number was expected"), _("Print it: what is it really?")),
    "not-finite": (_("A number without end"), _("Where does the program divide? By what?")),
    "wrong-key": (_("There is no such reading"), _("Compare the name with the list “It senses”.")),
    "unknown-name": (
        _("A name that has no value"),
        _("Search for the line in which the name gets its value. Is it spelled the same?"),
    ),
    "attribute": (_("Something unknown behind a dot"), _("What is it that stands before the dot?")),
    "endless": (_("A loop that never ends"), _("What must happen so that this loop ends?")),
    "recursion": (
        _("A function calls itself without end"),
        _("Which call is the last one, and why?"),
    ),
    "memory": (_("More memory than there is"), _("What grows here with each decision?")),
    "numpy": (
        _("numpy is not there"),
        _("A reading has .min(), .max(), .sum() and .mean() itself."),
    ),
    "import": (
        _("Something can't be imported"),
        _("The program may import what comes with Python."),
    ),
}
"""Title of each kind of mistake, and a question or advice for the teacher to say."""


@dataclass(frozen=True)
class ProgramRun:
    """The latest run of a seat's program."""

    state: RunState
    kind: str = ""
    """Kind of the mistake; empty for none."""
    text: str = ""
    """Sentence about it."""
    line: int = 0
    """Line of the program, from 1; 0 if there is none."""

    @property
    def mistake(self) -> str:
        """The mistake with its line; empty if there is none."""
        if self.state != "mistake":
            return ""
        return f"line {self.line}: {self.text}" if self.line else self.text


class ProgramRuns:
    """The latest run of each seat and counts of mistakes, in memory and in the class's file.

    Belongs to the event loop, except :meth:`save`.

    Args:
        store: of the class.
    """

    def __init__(self, store: ClassStore) -> None:
        self._store = store
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query("select seat, state, kind, text, line from program_runs")
        self._runs = {seat: ProgramRun(*rest) for seat, *rest in rows}
        rows = self._store.query("select seat, kind, text, count from program_mistakes")
        self._mistakes: dict[str, dict[int, tuple[int, str]]] = defaultdict(dict)
        for seat, kind, text, count in rows:
            self._mistakes[kind][seat] = count, text

    def save(self, seat: int, run: ProgramRun) -> None:
        """Store a run, and count its mistake; a thread may do it.

        Raises:
            StoreError: it can't be written.
        """
        with self._store.transaction() as database:
            database.execute(
                "insert or replace into program_runs values (?, ?, ?, ?, ?)",
                [seat, run.state, run.kind, run.text, run.line],
            )
            if run.state == "mistake":
                database.execute(
                    "insert into program_mistakes values (?, ?, ?, 1) "
                    "on conflict do update set count = count + 1, text = excluded.text",
                    [seat, run.kind, run.text],
                )

    def note(self, seat: int, run: ProgramRun) -> None:
        """Take over a run that is on disk."""
        self._runs[seat] = run
        if run.state == "mistake":
            seats = self._mistakes[run.kind]
            seats[seat] = seats.get(seat, (0, ""))[0] + 1, run.text

    def forget(self, seat: int) -> None:
        """Forget a seat that was deleted."""
        self._runs.pop(seat, None)
        for kind in [kind for kind, seats in self._mistakes.items() if seat in seats]:
            del self._mistakes[kind][seat]
            if not self._mistakes[kind]:
                del self._mistakes[kind]

    def mistake_of(self, seat: int) -> str:
        """Return the mistake that stopped a seat's program; empty if none did."""
        run = self._runs.get(seat)
        return run.mistake if run is not None else ""

    def by_seat(self) -> dict[str, dict[str, Any]]:
        """Return all runs as the teacher's page gets them."""
        return {
            str(seat): {"state": run.state, "text": run.text, "line": run.line}
            for seat, run in self._runs.items()
        }

    def mistakes(self) -> list[dict[str, Any]]:
        """Return the mistakes of the class, those of most seats first, with words for each."""
        rows = []
        for kind, seats in self._mistakes.items():
            title, advice = _WORDS.get(kind, _OTHER)
            examples = list(dict.fromkeys(text for _, text in seats.values()))
            rows.append(
                {
                    "kind": kind,
                    "title": title,
                    "count": sum(count for count, _ in seats.values()),
                    "seats": sorted(seats),
                    "examples": examples[:3],
                    "guide": advice,
                }
            )
        return sorted(rows, key=lambda row: (-len(row["seats"]), -row["count"], row["kind"]))


class Stars:
    """Stars that programs have earned in the scenes of the library, in memory and in a file.

    Belongs to the event loop, except :meth:`save`.

    Args:
        store: of the class.
    """

    def __init__(self, store: ClassStore) -> None:
        self._store = store
        self.read()

    def read(self) -> None:
        """Read all stars from the store."""
        self._of: dict[int, dict[str, int]] = defaultdict(dict)
        for seat, scene, count in self._store.query("select seat, scene, count from stars"):
            self._of[seat][scene] = count

    def save(self, seat: int, scene: str, count: int) -> None:
        """Store the stars of a seat in a scene, which never become fewer; a thread may do it.

        Raises:
            ValueError: there is no such scene in the library, or it has fewer stars.
            StoreError: it can't be written.
        """
        most = library_star_counts().get(scene, 0)
        if not 1 <= count <= most:
            raise ValueError(
                _(
                    "expected 1 to {most} stars in the scene {scene!r}, got {count}",
                    most=most,
                    scene=scene[:80],
                    count=count,
                )
            )
        with self._store.transaction() as database:
            database.execute(
                "insert into stars values (?, ?, ?) "
                "on conflict do update set count = max(count, excluded.count)",
                [seat, scene, count],
            )

    def note(self, seat: int, scene: str, count: int) -> None:
        """Take over stars that are on disk."""
        self._of[seat][scene] = max(count, self._of[seat].get(scene, 0))

    def forget(self, seat: int) -> None:
        """Forget a seat that was deleted."""
        self._of.pop(seat, None)

    def of_seat(self, seat: int) -> dict[str, int]:
        """Return the stars of a seat by scene."""
        return dict(self._of.get(seat, {}))

    def by_seat(self) -> dict[str, dict[str, int]]:
        """Return all stars as the teacher's page gets them."""
        return {str(seat): dict(stars) for seat, stars in self._of.items() if stars}
