"""File with a student's progress, in the folder of the notebooks."""

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass, field, fields, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import partial_file, write_atomically
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.lessons.prediction_values import Prediction, Value, read_predictions
from ai4u_edu.locale import gettext as _

FILE = "progress.json"
FOLDER = ".ai4u-edu"
"""Folder for the progress and the pictures of the checks."""
VERSION = 2
LOCK_FILE = "progress.lock"
LOCK_TIMEOUT_S = 30.0
"""Time-out for other notebooks that hold the file's lock; after it, an entry may get lost."""
LOCK_POLL_S = 0.002


@dataclass
class ExerciseProgress:
    """Progress in one exercise."""

    passed: bool = False
    when: str = ""
    """Local time at which it was passed first."""
    tries: int = 0
    """Checks up to the first that passed."""
    text: str = ""
    """Text of the last check."""
    diagnosis: str = ""
    """Id of the mistake that it found, such as ``04.2/narrow``."""
    diagnoses: dict[str, int] = field(default_factory=dict)
    """Count of the checks with each diagnosis, up to the first check that passed."""
    code: str = ""
    """Source of the exercise's cell; empty if not known."""


class ProgressFile:
    """Reader and writer of the progress file.

    Args:
        folder: the notebooks' folder; default: the current one.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or Path.cwd()
        self.path = self.folder / FILE
        self.trouble = ""
        """What was wrong with the file, in a sentence; empty if nothing was."""

    def entries(self) -> dict[str, ExerciseProgress]:
        """Return the entries by exercise id; a damaged file is renamed, and a new one begins."""
        return self._read()[0]

    def predictions(self) -> dict[str, Prediction]:
        """Return the predictions by id."""
        return self._read()[1]

    def note_prediction(
        self, prediction: str, *, guess: Value | None = None, actual: Value | None = None
    ) -> Prediction | None:
        """Save a guess, or the result of one; return both, or None without a guess."""
        with self._alone():
            entries, predictions = self._read()
            known = predictions.get(prediction)
            if guess is not None and (known is None or known.guess != guess):
                known = Prediction(guess)
            if known is None:
                return None
            known = known if actual is None else replace(known, actual=actual)
            predictions[prediction] = known
            self._write(entries, predictions)
        return known

    def _read(self) -> tuple[dict[str, ExerciseProgress], dict[str, Prediction]]:
        try:
            text = self.path.read_text(encoding="utf-8")
            return read_entries(text), read_predictions(json.loads(text).get("predictions"))
        except FileNotFoundError:
            pass
        except (OSError, ValueError) as error:  # UnicodeDecodeError is a ValueError
            self._set_aside(str(error))
        return {}, {}

    def note(
        self,
        exercise: str,
        *,
        passed: bool,
        text: str,
        diagnosis: str,
        picture: bytes,
        code: str = "",
    ) -> None:
        """Save a check's result; an exercise that was passed once stays passed."""
        with self._alone():
            self._note(exercise, passed, text, diagnosis, picture, code)

    def _note(
        self, exercise: str, passed: bool, text: str, diagnosis: str, picture: bytes, code: str
    ) -> None:
        entries, predictions = self._read()
        entry = entries.setdefault(exercise, ExerciseProgress())
        if not entry.passed:
            entry.tries += 1
            entry.passed = passed
            entry.when = datetime.now().isoformat(" ", "minutes") if passed else ""
            if diagnosis:
                entry.diagnoses[diagnosis] = entry.diagnoses.get(diagnosis, 0) + 1
        elif not passed:
            return
        entry.text, entry.diagnosis, entry.code = text, diagnosis, code
        self._write(entries, predictions)
        if picture:
            place = self.picture(exercise)
            place.parent.mkdir(exist_ok=True)
            write_atomically(place, picture)

    def picture(self, exercise: str) -> Path:
        """Return the path of the last check's picture, if there is one."""
        return self.folder / FOLDER / f"{exercise}.picture"

    def _write(
        self, entries: dict[str, ExerciseProgress], predictions: dict[str, Prediction]
    ) -> None:
        plain: dict[str, Any] = {
            "version": VERSION,
            "exercises": {name: asdict(entries[name]) for name in sorted(entries)},
        }
        if predictions:
            plain["predictions"] = {name: asdict(predictions[name]) for name in sorted(predictions)}
        with partial_file(self.path) as beside, beside.open("w", encoding="utf-8") as out:
            json.dump(plain, out, indent=1)

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Exclude other notebooks: each reads the file, and writes all of it again."""
        deadline, lock = time.monotonic() + LOCK_TIMEOUT_S, None
        with suppress(OSError):  # the write itself reports a folder that can't be written to
            (self.folder / FOLDER).mkdir(exist_ok=True)
            while lock is None:
                try:
                    lock = FileLock(self.folder / FOLDER / LOCK_FILE)
                except LockedError:
                    if time.monotonic() > deadline:
                        break
                    time.sleep(LOCK_POLL_S)
        try:
            yield
        finally:
            if lock is not None:
                lock.release()

    def _set_aside(self, why: str) -> None:
        aside = self.path.with_name("progress.damaged.json")
        self.trouble = _("{file} could not be read ({why})", file=FILE, why=why)
        try:
            self.path.replace(aside)
        except OSError:
            return
        self.trouble = _(
            "{file} could not be read ({why}); it was put aside as {aside}, and a new one is begun",
            file=FILE,
            why=why,
            aside=aside.name,
        )


def read_entries(text: str) -> dict[str, ExerciseProgress]:
    """Return the entries of a progress file by exercise id.

    Raises:
        ValueError: the text is damaged, or of another version.
    """
    try:
        plain = json.loads(text)
        entries = {str(name): _entry(each) for name, each in plain["exercises"].items()}
        version = plain["version"]
    except (TypeError, KeyError, AttributeError, RecursionError) as error:
        raise ValueError(str(error)) from error
    if version == 1:
        return {_moved(name): _moved_entry(each) for name, each in entries.items()}
    if version != VERSION:
        raise ValueError(f"version {version!r}, expected {VERSION}")
    return entries


def _moved_entry(entry: ExerciseProgress) -> ExerciseProgress:
    """Return an entry of version 1 with the new ids of its diagnoses."""
    counts = {_moved(name): count for name, count in entry.diagnoses.items()}
    return replace(entry, diagnosis=_moved(entry.diagnosis), diagnoses=counts)


def _moved(name: str) -> str:
    """Return the new id of an exercise, or of one of its diagnoses.

    >>> [_moved(each) for each in ("03.2", "12.3/late", "00.1", "any/no-return", "")]
    ['04.2', '17.4/late', '00.1', 'any/no-return', '']
    """
    exercise, slash, diagnosis = name.partition("/")
    lesson, dot, number = exercise.partition(".")
    new = _MOVED_EXERCISES.get(exercise, f"{_MOVED_LESSONS.get(lesson, lesson)}{dot}{number}")
    return f"{new}{slash}{diagnosis}"


def _entry(plain: object) -> ExerciseProgress:
    if not isinstance(plain, dict):
        raise TypeError(f"expected an entry, got {plain!r}")
    plain = {name: each for name, each in plain.items() if name != "hint"}  # of older versions
    entry = ExerciseProgress(**plain)
    for name, kind in _KINDS.items():
        if type(getattr(entry, name)) is not kind:
            raise TypeError(f"{name}: expected {kind.__name__}, got {getattr(entry, name)!r}")
    for name, count in entry.diagnoses.items():
        if type(name) is not str or type(count) is not int:
            raise TypeError(f"diagnoses: expected counts, got {entry.diagnoses!r}")
    return entry


_KINDS: dict[str, type] = {
    each.name: type(getattr(ExerciseProgress(), each.name)) for each in fields(ExerciseProgress)
}

_MOVED_LESSONS = {
    "01": "02",
    "02": "03",
    "03": "04",
    "04": "05",
    "05": "06",
    "06": "08",
    "07": "09",
    "08": "15",
    "09": "10",
    "10": "11",
    "11": "12",
    "12": "16",
    "13": "18",
    "14": "19",
    "15": "20",
}
"""New numbers of the lessons of the first course, whose progress files have version 1."""
_MOVED_EXERCISES = {"05.3": "07.1", "11.4": "13.3", "12.3": "17.4"}
"""Exercises that went to another lesson than the others of theirs."""
