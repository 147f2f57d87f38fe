"""Feed a target and measure errors, time and memory."""

import gc
import random
import resource
import signal
import sys
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

from tests.fuzz.target import Target

MAX_INPUT_CPU_S = 1.0
"""Longest processor time (s) of one input, which other programs and threads take no part in."""
MAX_LEAKED_OBJECTS = 0.1
"""Most objects left behind per input. A leak leaves one or more, a cache that fills up fewer."""
MAX_FINDINGS = 5
"""Findings after which a run stops."""


class HangError(BaseException):
    """An input took too long. A BaseException, so that no ``except Exception`` catches it."""


@dataclass
class Report:
    """Result of a run."""

    name: str
    inputs: int = 0
    right: int = 0
    slowest: float = 0.0
    """Seconds of processor time."""
    left: float = 0.0
    """Objects left behind by an input, on average."""
    megabytes: float = 0.0
    """Growth of the process's memory after the first fifth of the inputs."""
    seconds: float = 0.0
    findings: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        return (
            f"{self.name:<14} {self.inputs:>9,} inputs ({self.right:,} right) in "
            f"{self.seconds:.0f} s; slowest {self.slowest * 1000:.1f} ms; left behind "
            f"{self.left:.5f} objects an input, {self.megabytes:+.1f} MB; "
            f"findings: {len(self.findings)}"
        )


def run(target: Target, inputs: int, seed: int = 0) -> Report:
    """Feed a target with inputs that depend on the seed alone."""
    rng = random.Random(seed)
    report = Report(target.name)
    began = time.perf_counter()  # real time: for the report alone
    warm = max(inputs // 5, 1)
    blocks, memory = 0, 0.0
    with _watched() as watch:
        while report.inputs < inputs and len(report.findings) < MAX_FINDINGS:
            if report.inputs == warm:
                blocks, memory = _blocks(), _megabytes()
            _feed(target, target.make(rng), report, watch)
    if report.inputs > warm:
        report.left = max(0, _blocks() - blocks) / (report.inputs - warm)
        report.megabytes = _megabytes() - memory
        if report.left > MAX_LEAKED_OBJECTS and report.inputs >= 10_000:
            report.findings.append(f"{report.left:.3f} objects stay after each input")
    report.seconds = time.perf_counter() - began  # real time: for the report alone
    return report


def _feed(target: Target, data: bytes, report: Report, watch: "_Watch") -> None:
    report.inputs += 1
    watch.begin()
    try:
        report.right += target.reads(data)
    except HangError as hang:
        report.findings.append(_finding("more than a second", data, hang))
    except Exception as error:
        report.findings.append(_finding(repr(error), data, error))
    finally:
        report.slowest = max(report.slowest, watch.end())


def _finding(what: str, data: bytes, error: BaseException) -> str:
    frames = [each for each in traceback.extract_tb(error.__traceback__) if "fuzz" not in each[0]]
    where = frames[-1] if frames else traceback.extract_tb(error.__traceback__)[-1]
    shown = repr(data) if len(data) <= 3000 else f"{data[:3000]!r}... ({len(data)} bytes)"
    return f"{what[:200]} at {where.filename}:{where.lineno}\n  input: {shown}"


class _Watch:
    """Raises :class:`HangError` in this thread when an input takes too much of its time."""

    def __init__(self) -> None:
        self._began = 0.0

    def begin(self) -> None:
        self._began = time.thread_time()
        signal.setitimer(signal.ITIMER_VIRTUAL, MAX_INPUT_CPU_S)

    def end(self) -> float:
        """Return the processor time (s) of the input."""
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        return time.thread_time() - self._began

    def ring(self, _number: int, _frame: FrameType | None) -> None:
        # the timer counts the time of all threads, also of those that other tests left behind
        left = MAX_INPUT_CPU_S - (time.thread_time() - self._began)
        if left <= 0:
            raise HangError
        signal.setitimer(signal.ITIMER_VIRTUAL, max(left, 0.001))  # 0 would end it


@contextmanager
def _watched() -> Iterator[_Watch]:
    watch = _Watch()
    before = signal.signal(signal.SIGVTALRM, watch.ring)
    try:
        yield watch
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def _blocks() -> int:
    gc.collect()
    return sys.getallocatedblocks()


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
