"""Lessons in a real Jupyter kernel, with the solutions in place."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ai4u_edu.lessons.course import Lesson
from ai4u_edu.lessons.notebook import Cell, dumps
from ai4u_edu.lessons.progress_file import ExerciseProgress, ProgressFile
from tests.lessons.workbook import solution_of, solved
from tests.waiting import LIMIT_S

ROOT = Path(__file__).parents[2]
PATIENT = """from ai4u_edu.lessons.course import lesson
from tests.lessons.workbook import be_patient
be_patient(lesson("{}"))"""
"""Cell before the others."""


@dataclass
class Executed:
    """A notebook that was run."""

    book: Any
    entries: dict[str, ExerciseProgress]
    seconds: float
    slowest: float
    """Seconds that the slowest cell took."""

    @property
    def complaints(self) -> list[Any]:
        """Errors, and whatever was written to stderr."""
        outs = [out for cell in self.book.cells for out in cell.get("outputs", ())]
        return [out for out in outs if out.output_type == "error" or out.get("name") == "stderr"]


@contextmanager
def kernel_config() -> Iterator[Any]:
    """Settings of a kernel that is reached by Unix sockets, as a ``traitlets.config.Config``.

    Ports are chosen and closed again before the kernel starts: another process may take them.
    The path of a socket has to be shorter than most of pytest's folders are.
    """
    from traitlets.config import Config

    with TemporaryDirectory(prefix="kernel-") as folder:
        connection_file = str(Path(folder, "kernel.json"))
        yield Config(KernelManager={"transport": "ipc", "connection_file": connection_file})


def executed(lesson: Lesson, folder: Path) -> Executed:
    """Runs a lesson from top to bottom, in a folder."""
    # they take seconds to import, in each process that collects tests
    import nbformat
    from nbclient import NotebookClient

    read: Any = nbformat.reads
    answers = {each: solution_of(each) for each in lesson.exercises}
    cells = [Cell(PATIENT.format(lesson.number)), *solved(lesson, answers)]
    book = read(dumps(cells), as_version=4)
    times: list[float] = []
    now = time.perf_counter  # real time: for tests.lessons.full; no test depends on it
    with kernel_config() as config:
        client = NotebookClient(
            book,
            config=config,
            # a cell may train; if the kernel dies, the client knows that
            timeout=None,
            startup_timeout=LIMIT_S,
            iopub_timeout=LIMIT_S,
            kernel_name="python3",
            resources={"metadata": {"path": str(folder)}},
            on_cell_start=lambda **_: times.append(now()),
        )
        began = now()
        client.execute(env={**os.environ, "PYTHONPATH": str(ROOT)})
    ends = [*times[1:], now()]
    slowest = max(end - start for start, end in zip(times, ends, strict=True))
    return Executed(book, ProgressFile(folder).entries(), ends[-1] - began, slowest)
