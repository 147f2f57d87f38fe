"""Time limit for a student's code that is called by a check."""

import ast
import ctypes
import linecache
import signal
import sys
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from types import FrameType, TracebackType
from typing import Any, Self

from ai4u_edu.agent.block_frames import frames_of_thread, line_at
from ai4u_edu.base.syntax import parsed
from ai4u_edu.lessons.student_errors import is_students, line_words
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _
from ai4u_edu.program.endless import loop_around, suspicion, why_endless
from ai4u_edu.program.texts import make_texts_with

make_texts_with(Text)

CALL_LIMIT_S = 5.0
"""Longest time that one call of a student's function may take."""
TOTAL_LIMIT_S = 90.0
"""Longest time that all calls of a check may take together."""
DECISIONS_SHARE = 1 / 3
"""Part of that time for a robot's decisions, which take microseconds each as a rule."""
SAMPLE_S = 0.2
"""Interval at which the stack is looked at."""


class TimeLimitError(BaseException):
    """Raised in a student's code that takes too long; ``except Exception`` does not catch it."""


class TimeLimit:
    """Context in which no call of a student's function may take too long.

    The thread's stack is sampled: on a POSIX main thread by a timer signal, which also ends a
    ``sleep``; elsewhere by a watchdog thread, which raises the error asynchronously. A call is the
    outermost frame of a student's; what stands on the stack before the context is none.

    Args:
        call_s: longest time of one call, seconds.
        total_s: longest time of all calls together, seconds.
    """

    def __init__(self, call_s: float = CALL_LIMIT_S, total_s: float = TOTAL_LIMIT_S) -> None:
        self.call_s, self.total_s = call_s, total_s
        self.text = ""
        """Sentence on the call that took too long."""
        self.diagnosis = ""
        """Name of the diagnosis: ``endless`` for one call of a robot's driver, ``endless-loop`` for
        one of another function, ``slow`` for all calls together."""
        self._root: FrameType | None = None
        self._call: FrameType | None = None
        self._since = self._total = self._last = 0.0
        self._ended = threading.Event()
        self._lock = threading.Lock()
        self._timer: tuple[Any, float, float, float] | None = None

    def __enter__(self) -> Self:
        self._root = sys._getframe(1)
        self._last = time.monotonic()
        if sys.platform != "win32" and threading.current_thread() is threading.main_thread():
            handler = signal.signal(signal.SIGALRM, self._on_signal)
            remaining, interval = signal.setitimer(signal.ITIMER_REAL, SAMPLE_S, SAMPLE_S)
            self._timer = handler, remaining, interval, self._last
        else:
            watch = threading.Thread(
                target=self._watch, args=(threading.get_ident(),), daemon=True, name="time-limit"
            )
            watch.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, traceback: TracebackType | None
    ) -> None:
        try:
            with self._lock:  # from here on nothing more is raised
                self._ended.set()
        except TimeLimitError:  # raised a moment before, and arrived here: the call has ended
            self._ended.set()
        if sys.platform != "win32" and self._timer is not None:
            handler, remaining, interval, began = self._timer
            if remaining:  # somebody else's timer goes on
                remaining = max(0.001, remaining - (time.monotonic() - began))
            signal.setitimer(signal.ITIMER_REAL, remaining, interval)
            signal.signal(signal.SIGALRM, handler)
        self._root = self._call = None

    def _on_signal(self, _number: int, frame: FrameType | None) -> None:
        if not self._ended.is_set() and self._is_over(_calls_from(frame)):
            raise TimeLimitError

    def _watch(self, thread: int) -> None:
        while not self._ended.wait(SAMPLE_S):
            frames = frames_of_thread(thread)[::-1]
            with self._lock:
                if not self._ended.is_set() and self._is_over(frames):
                    raise_in(thread, TimeLimitError)
            del frames

    def _is_over(self, frames: Iterable[FrameType]) -> bool:
        """Look at the stack; return True if a call has taken too long.

        Args:
            frames: of the thread, the innermost one first.
        """
        now = time.monotonic()
        passed, self._last = now - self._last, now
        calls = self._students_frames(frames)
        if not calls:
            self._call = None
            return False
        self._total += passed
        if calls[-1] is not self._call:
            self._call, self._since = calls[-1], now
        is_endless = now - self._since >= self.call_s
        total_s = self.total_s * (DECISIONS_SHARE if _is_decision(calls[-1]) else 1)
        if not is_endless and self._total < total_s:
            return False
        if is_endless:
            self.text = endless_call(calls, self.call_s)
            self.diagnosis = "endless" if _is_decision(calls[-1]) else "endless-loop"
        else:
            self.text = _(
                "All calls of your code took more than {seconds:g} s together. Each of them is "
                "slow ({place}).",
                seconds=total_s,
                place=_place_of(calls[0]),
            )
            self.diagnosis = "slow"
        return True

    def _students_frames(self, frames: Iterable[FrameType]) -> list[FrameType]:
        """Return the student's frames since the context began, the innermost one first."""
        found: list[FrameType] = []
        for frame in frames:
            if frame is self._root:
                return found
            if is_students(frame.f_code.co_filename):
                found.append(frame)
        return []


def _calls_from(frame: FrameType | None) -> Iterator[FrameType]:
    """Yield a frame of this thread, and those that called it."""
    while frame is not None:
        yield frame
        frame = frame.f_back


def endless_call(calls: Sequence[FrameType], seconds: float) -> str:
    """Return a sentence on a call that does not end.

    Args:
        calls: the student's frames, the innermost one first; at least one.
        seconds: time since the call began.
    """
    loops = [(call, loop) for call in calls if (loop := _loop_around(call))]
    frame, loop = max(loops, key=lambda each: suspicion(each[1]), default=(calls[0], None))
    place = line_words(frame.f_code.co_filename, loop.lineno) if loop else _place_of(frame)
    why = why_endless(loop, is_in_decision=_is_decision(calls[-1]))
    return _(
        "Your code did not answer for {seconds:g} s ({place}). {why}",
        seconds=seconds,
        place=place,
        why=why,
    )


def raise_in(thread: int, error: type[BaseException]) -> None:
    """Raise an error in another thread, when that thread next runs a line of Python.

    It can't be withdrawn: with NULL in place of an error CPython 3.11 notes an error that never
    arrives, and the next function of the process that is traced waits for it for ever.

    Args:
        thread: identifier of the thread, as ``threading.get_ident`` returns it.
        error: class of the error.
    """
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(error))


def _is_decision(frame: FrameType) -> bool:
    """Return True for a call of a function, or a method, that gets a percept alone."""
    code = frame.f_code
    return code.co_varnames[: code.co_argcount] in (("percept",), ("self", "percept"))


def _place_of(frame: FrameType) -> str:
    """Return the line that a frame is at, in words."""
    return line_words(frame.f_code.co_filename, line_at(frame.f_code, frame.f_lasti))


def _loop_around(frame: FrameType) -> ast.While | ast.For | None:
    """Return the loop around a frame's present line."""
    code = frame.f_code
    try:
        tree = parsed("".join(linecache.getlines(code.co_filename)))
    except (SyntaxError, ValueError):
        return None
    return loop_around(tree, line_at(code, frame.f_lasti), code.co_firstlineno)
