"""Files that a failed test leaves behind: pictures, consoles, logs and the last messages.

Whoever a story consists of (a page, a served process, a client's messages) is a witness: it is
registered when it is made, and asked when the test has failed. A traceback alone says what was
expected, and seldom why it did not happen.
"""

import contextlib
import json
import re
from collections import deque
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Protocol
from weakref import WeakSet

import pytest

RESULTS = Path(__file__).resolve().parent.parent / "build" / "test-results"
"""Default folder for the results of a run."""
LAST_MESSAGES = 50
MAX_MESSAGE_CHARS = 2000
MAX_NAME_CHARS = 120


class Witness(Protocol):
    """Part of a story that can tell what happened."""

    def testify(self) -> dict[str, str | bytes]:
        """Return the contents of files by their names."""
        ...


begun: list[str] = []
"""Ids of the tests that this process has begun: an earlier one may be the cause of a failure."""
_witnesses: WeakSet[Any] = WeakSet()  # of Witness; a traceback keeps those of its test alive


def register(witness: Witness) -> None:
    """Ask this witness if a test fails while it is there."""
    _witnesses.add(witness)


class Messages:
    """The last messages of a client or a server, sent and received.

    Args:
        name: of the file that is kept of them.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._last: deque[str] = deque(maxlen=LAST_MESSAGES)
        register(self)

    def sent(self, message: object) -> None:
        """Note a message that was sent."""
        self._last.append(f"> {_short(message)}")

    def received(self, message: object) -> None:
        """Note a message that was received."""
        self._last.append(f"< {_short(message)}")

    def testify(self) -> dict[str, str | bytes]:
        """Return the messages, the oldest first."""
        return {f"{self._name}.txt": "\n".join(self._last)}


class KeptFile:
    """File of a server or another program, such as its log."""

    def __init__(self, path: Path) -> None:
        self.path = path
        register(self)

    def testify(self) -> dict[str, str | bytes]:
        """Return what the file holds."""
        return {self.path.name: self.path.read_bytes()} if self.path.exists() else {}


def _short(message: object) -> str:
    if isinstance(message, dict):
        with contextlib.suppress(TypeError, ValueError):
            message = json.dumps(message)
    text = message if isinstance(message, str) else repr(message)
    return text[:MAX_MESSAGE_CHARS]


def keep(report: pytest.TestReport, results: Path) -> None:
    """Write what all witnesses say of a failed test, and name the folder in its report."""
    name = re.sub(r"[^\w.\[\]-]+", "_", report.nodeid)[-MAX_NAME_CHARS:].lstrip("_.")
    folder = results / "failures" / name
    folder.mkdir(parents=True, exist_ok=True)
    for file, content in _files(report):
        path = _free(folder / file)
        if isinstance(content, bytes):
            path.write_bytes(content)
        else:
            path.write_text(content, encoding="utf-8", errors="replace")
    report.sections.append(("kept files", str(folder)))


def _files(report: pytest.TestReport) -> Iterator[tuple[str, str | bytes]]:
    sections = [f"--- {title}\n{text}" for title, text in report.sections]
    yield f"{report.when}.txt", "\n".join([report.longreprtext, *sections])
    yield "tests-before.txt", "\n".join(begun[:-1])
    for witness in list(_witnesses):
        try:
            yield from witness.testify().items()
        except Exception as error:  # a witness in ruins must not hide the failure
            yield f"{type(witness).__name__}-error.txt", repr(error)


def _free(path: Path) -> Path:
    """Return a path at which nothing is yet: several witnesses may be of one kind."""
    number, free = 2, path
    while free.exists():
        free = path.with_stem(f"{path.stem}-{number}")
        number += 1
    return free
