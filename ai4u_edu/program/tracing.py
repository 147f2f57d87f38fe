"""Trace of what a program runs in one decision, and the time limit of that decision."""

import sys
import time
from collections.abc import Callable, Mapping, Set
from types import FrameType, FunctionType, ModuleType
from typing import Any, NamedTuple

from ai4u_edu.program.endless import line_at
from ai4u_edu.program.words import shown

DECISION_LIMIT_S = 1.0
"""Longest time that a program may take for a decision."""
MAX_LINES = 500
"""Lines that a trace keeps of one decision; the first ones."""
MAX_REPORTED_LINES = 50
"""Lines of a call that are reported before they run; after them, only those not reported yet."""
MAX_MOMENTS = 60
"""Lines that a trace shows with their variables, from the first one at which it stops."""
MAX_VARIABLES = 40
MAX_VALUE_CHARS = 120
"""Length of a variable's value in a trace."""
LINES_BETWEEN_CHECKS = 16
"""Lines between two looks at the clock, which costs more than to count a line."""
ReportLine = Callable[[int], object]
"""Function that takes the number of a line."""


FIRST_LINE = 0
"""Stands among the lines to stop at for the first line that a call runs."""


class TracedMoment(NamedTuple):
    """A moment just before a line ran."""

    line: int
    variables: dict[str, str]
    """Names, and beginnings of values."""


class EndlessError(BaseException):
    """A call takes too long; ``except Exception`` in a program does not catch it.

    Args:
        line: of the program, that was about to run.
    """

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


class Trace:
    """The lines that one call of a program ran, and its variables at the end.

    Only lines of the program's own file count. Where a debugger traces already, nothing is
    recorded and no time limit holds.

    Args:
        file: name of the program's file, as it was compiled.
        limit_s: longest time of a call, seconds.
        keeps_lines: False records neither lines nor variables.
        report_line: called with a line before it runs. So the page knows where a program stands
            that no tracing can stop, such as ``10**10**8``.
    """

    def __init__(
        self,
        file: str,
        limit_s: float = DECISION_LIMIT_S,
        *,
        keeps_lines: bool = True,
        report_line: ReportLine | None = None,
    ) -> None:
        self.lines: list[int] = []
        """Numbers of the lines that ran, in order."""
        self.last_line = 0
        """Line at which the outermost function returned."""
        self.stops: Set[int] = frozenset()
        """Lines to stop at, or :data:`FIRST_LINE`; the program runs on, and pages show it there."""
        self.moments: list[TracedMoment] = []
        """The moments of the last call, from the first such line on."""
        self._file = file
        self.limit_s = limit_s
        self._keeps_lines = keeps_lines
        self._report_line = report_line
        self._deadline = 0.0
        self._left = 0
        self._reported: set[int] = set()
        self._reports = 0
        self._outermost: FrameType | None = None
        self._locals: dict[str, Any] = {}

    def run(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Call a function of the program and return its result.

        Raises:
            EndlessError: it took too long.
        """
        self.lines = []
        self.moments = []
        self.last_line = 0
        self._locals = {}
        if sys.gettrace() is not None:
            return function(*arguments)
        self._deadline = time.monotonic() + self.limit_s
        self._left = LINES_BETWEEN_CHECKS
        self._reported.clear()
        self._reports = 0
        sys.settrace(self._on_call)
        try:
            return function(*arguments)
        finally:
            sys.settrace(None)
            self._outermost = None

    def variables(self, module: dict[str, Any]) -> dict[str, str]:
        """Return the variables at the end of the last call: names, and beginnings of values.

        Args:
            module: the program's global variables.
        """
        return _variables(self._locals, module)

    def _on_call(self, frame: FrameType, _event: str, _argument: Any) -> Any:
        if frame.f_code.co_filename != self._file:
            return None
        if self._outermost is None:
            self._outermost = frame
        return self._on_event

    def _on_event(self, frame: FrameType, event: str, _argument: Any) -> Any:
        if event == "line":
            if self._report_line is not None:
                self._report(frame.f_lineno, self._report_line)
            if self._keeps_lines and len(self.lines) < MAX_LINES:
                self.lines.append(frame.f_lineno)
            if self.stops and len(self.moments) < MAX_MOMENTS:
                is_stop = frame.f_lineno in self.stops or FIRST_LINE in self.stops
                if self.moments or is_stop:
                    variables = _variables(frame.f_locals, frame.f_globals)
                    self.moments.append(TracedMoment(frame.f_lineno, variables))
            self._left -= 1
            if self._left <= 0:
                self._left = LINES_BETWEEN_CHECKS
                if time.monotonic() > self._deadline:
                    raise EndlessError(frame.f_lineno)
        elif event == "return" and frame is self._outermost:
            self.last_line = line_at(frame.f_code, frame.f_lasti)
            if self._keeps_lines:
                self._locals = dict(frame.f_locals)
        return self._on_event

    def _report(self, line: int, report: ReportLine) -> None:
        self._reports += 1
        if self._reports <= MAX_REPORTED_LINES or line not in self._reported:
            self._reported.add(line)
            report(line)


def _variables(local: Mapping[str, Any], module: Mapping[str, Any]) -> dict[str, str]:
    """Return a function's variables and the program's global ones: names, beginnings of values."""
    own = local.get("self")
    memory = getattr(own, "__dict__", None) if own is not None else None
    found: dict[str, Any] = {
        name: value for name, value in local.items() if name not in ("self", "percept")
    }
    if type(memory) is dict:
        found |= {f"self.{name}": value for name, value in memory.items()}
    found |= {
        name: value
        for name, value in module.items()
        if not name.startswith("_")
        and name not in found
        and not issubclass(type(value), type | FunctionType | ModuleType)
    }
    kept = list(found.items())[:MAX_VARIABLES]
    return {name[:MAX_VALUE_CHARS]: shown(value, MAX_VALUE_CHARS) for name, value in kept}
