"""Latest runs of students' programs, and the mistakes that stopped them.

A student's page tells it, as a notebook tells the results of exercises; nobody proves it.
"""

from collections import defaultdict
from dataclasses import dataclass
from typing import Any, Literal

from ai4u_edu.classroom.store import ClassStore

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
OTHER = ("Python stopped", "Read the last words of the sentence aloud: which word is new?")
WORDS: dict[str, tuple[str, str]] = {
    "syntax": (
        "Python can't read a line",
        "Read the line aloud, with every sign. Which one is missing, or too many?",
    ),
    "indentation": (
        "Spaces at the beginning of a line",
        "What belongs together begins at the same place: four spaces after each colon.",
    ),
    "entry": ("decide(percept) is missing", "The robot calls `decide` by its name."),
    "parameters": (
        "The brackets of a function do not fit its call",
        "Count what stands in the brackets after `def`, and in the call.",
    ),
    "no-return": (
        "Nothing is returned",
        "Follow the program with a finger: is there a way past every `return`?",
    ),
    "action": (
        "The action has another form",
        "Look at “It can do”: a name, and a list of numbers.",
    ),
    "actuator": ("There is no such actuator", "Compare the name with the list “It can do”."),
    "length": ("Too many or too few numbers", "Count the numbers in the list “It can do”."),
    "not-a-number": ("A number was expected", "Print it: what is it really?"),
    "not-finite": ("A number without end", "Where does the program divide? By what?"),
    "wrong-key": ("There is no such reading", "Compare the name with the list “It senses”."),
    "unknown-name": (
        "A name that has no value",
        "Search for the line in which the name gets its value. Is it spelled the same?",
    ),
    "attribute": ("Something unknown behind a dot", "What is it that stands before the dot?"),
    "endless": ("A loop that never ends", "What must happen so that this loop ends?"),
    "recursion": ("A function calls itself without end", "Which call is the last one, and why?"),
    "memory": ("More memory than there is", "What grows here with each decision?"),
    "numpy": ("numpy is not there", "A reading has .min(), .max(), .sum() and .mean() itself."),
    "import": ("Something can't be imported", "The program may import what comes with Python."),
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
            title, advice = WORDS.get(kind, OTHER)
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
