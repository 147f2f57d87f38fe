"""The journal of jobs that were done: a file with a line of JSON for each."""

import json
import os
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, BinaryIO, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.base.file_lock import FileLock, LockedError
from ai4u_edu.games.jobs.job import Job, JobOutcome
from ai4u_edu.locale import gettext as _

FILE = "journal.jsonl"
MAX_ARGUMENT_CHARS = 200
"""Length of a text in a job's arguments; of longer ones, such as networks, a beginning is kept."""


class Journal:
    """Keeps the results of jobs in a folder; a context manager.

    Each result is on the disk when :meth:`add` returns. Jobs that failed are noted, and run again.

    Args:
        folder: is made if it is not there.

    Raises:
        SetupError: another process writes there, or the file is no journal.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.path = folder / FILE
        try:
            self._lock = FileLock(folder / f"{FILE}.lock")
        except LockedError as error:
            raise SetupError(
                _("{folder}: another process runs these jobs; end it first", folder=str(folder))
            ) from error
        try:
            self._done = self._read()
            self._file: BinaryIO = self.path.open("ab")
        except BaseException:
            self._lock.release()
            raise

    def __contains__(self, job: Job) -> bool:
        return job.key in self._done

    def __len__(self) -> int:
        return len(self._done)

    def outcome(self, job: Job) -> JobOutcome:
        """Return how a job was done.

        Raises:
            KeyError: it was not.
        """
        kept = self._done[job.key]
        return JobOutcome(job, kept["result"], "", kept["tries"], kept["seconds"])

    def add(self, outcome: JobOutcome) -> None:
        """Write how a job ended."""
        line = line_of(outcome)
        self._file.write(json.dumps(line).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())
        if outcome.is_done:
            self._done[outcome.job.key] = line

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        self._lock.release(remove=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _read(self) -> dict[str, dict[str, Any]]:
        """Return the done jobs by key; cut off a last line that was not written to its end."""
        if not self.path.exists():
            return {}
        content = self.path.read_bytes()
        whole = content[: content.rfind(b"\n") + 1]
        if whole != content:
            os.truncate(self.path, len(whole))
        done = {}
        for number, line in enumerate(whole.splitlines(), 1):
            try:
                kept = read_line(line)
            except ValueError as error:
                raise SetupError(
                    _(
                        "{path}, line {number}: expected a finished job, got {line} ({problem}); "
                        "mend the line, or choose another folder",
                        path=str(self.path),
                        number=number,
                        line=repr(line[:80]),
                        problem=text_of(error),
                    )
                ) from error
            if not kept["error"]:
                done[kept["key"]] = kept
        return done


def count_done(folder: Path) -> int:
    """Return how many jobs the journal of a folder has results of; nobody need have it open."""
    done = 0
    with suppress(OSError, ValueError), (folder / FILE).open("rb") as lines:
        for line in lines:
            done += not read_line(line)["error"]
    return done


class _Line(BaseModel):
    """Form of a line: data, of which nothing is executed."""

    model_config = ConfigDict(extra="forbid", strict=True)

    key: str
    function: str
    arguments: dict[str, Any]
    result: Any
    error: str
    tries: Annotated[int, Field(ge=1)]
    seconds: Annotated[float, Field(ge=0, allow_inf_nan=False)]


def line_of(outcome: JobOutcome) -> dict[str, Any]:
    """Return what a journal notes of a job that has ended."""
    return {
        "key": outcome.job.key,
        "function": outcome.job.function,
        "arguments": _shortened(outcome.job.arguments),
        "result": outcome.result,
        "error": outcome.error,
        "tries": outcome.tries,
        "seconds": round(outcome.seconds, 3),
    }


def read_line(line: bytes) -> dict[str, Any]:
    """Return what a line of a journal says, as :func:`line_of` gave it.

    Raises:
        ValueError: it says something else.
    """
    try:
        found: dict[str, Any] = _Line.model_validate(json.loads(line)).model_dump()
    except ValidationError as error:
        first = error.errors()[0]
        raise ValueError(f"{'.'.join(map(str, first['loc']))}: {first['msg']}") from None
    except RecursionError:
        raise ValueError(_("it is nested too deeply")) from None
    return found


def _shortened(value: Any) -> Any:
    """Return data with short texts; the job's key has the whole of it."""
    if isinstance(value, dict):
        return {name: _shortened(each) for name, each in value.items()}
    if isinstance(value, list):
        return [_shortened(each) for each in value]
    if isinstance(value, str) and len(value) > MAX_ARGUMENT_CHARS:
        return f"{value[:20]}… ({len(value)} characters)"
    return value
