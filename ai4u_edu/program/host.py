"""Entry of the page's worker: functions that take and return JSON texts.

The page has the files of this package in a folder ``ai4u_edu/program`` on ``sys.path``, and no
other file of ai4u_edu, not even its ``__init__.py``.

====== ============================================= ===============================================
call   takes                                         returns
====== ============================================= ===============================================
load   source, outputs, readings;                    ok
       optional: entry, limit_s, has_entry
begin                                                ok
decide percept, decision; optional: stops            ok, values, printed, lines, variables, moments
call   name, arguments                               ok, value, printed, lines, variables
====== ============================================= ===============================================

A mistake is returned as ``{"ok": false, "text", "line", "kind"}`` with printed, lines and variables
as far as they are known; it is never raised. ``begin`` and ``load`` return what was printed too.
``stops`` is a list of lines to stop at, 0 for the first one that runs; from the first of them on,
``moments`` has each line that ran with the variables before it, as a page shows them one by one.
``translate`` takes the page's catalogue. ``watch`` takes a function, which is called with a line
before it runs.

``call`` calls a function of the program, for whoever loaded it with ``has_entry`` false. Arguments
and value are JSON texts in the JSON text, so that the page's JavaScript does not make 1 of 1.0. An
argument is a number, bool or text, a list of such, ``{"array": [...]}`` or ``{"percept": {...}}``,
which both become readings. In the value, ``{"shown": "<set>"}`` stands for what JSON does not have,
``{"number": "inf"}`` for a number without one, and ``{"table": [[key, value], ...]}`` for a dict.

- ``outputs`` is ``{name: [[low, ...], [high, ...]]}``.
- ``limit_s`` is the longest time of a call (s).
- ``readings`` is a list of the percept's keys, or ``{key: dtype}`` with the welcome's dtypes
  (``<f4``, ``<i4``, ``|b1``, ``|u1``; empty for text). With dtypes, numbers get the type that they
  have outside the page: JavaScript writes 1.0 as 1.
- JSON has no infinities, and JavaScript writes -0 as 0. So such numbers are texts: ``"inf"``,
  ``"-inf"``, ``"nan"``, ``"-0"``; infinite limits in ``outputs`` too. With dtypes, readings that
  are text are never taken for numbers.
"""

import json
from collections.abc import Callable
from math import isfinite
from typing import Any

from ai4u_edu.program.mistakes import ProgramError
from ai4u_edu.program.output import PrintedOutput
from ai4u_edu.program.program import Program
from ai4u_edu.program.reading import Reading, readings_of
from ai4u_edu.program.texts import gettext as _
from ai4u_edu.program.texts import translate_with
from ai4u_edu.program.tracing import DECISION_LIMIT_S, ReportLine
from ai4u_edu.program.words import shown

WORDS = {"inf": float("inf"), "-inf": float("-inf"), "nan": float("nan"), "-0": -0.0}
"""Numbers that are written as texts."""
CASTS: dict[str, Callable[[Any], Any]] = {"<f4": float, "<i4": int, "|u1": int, "|b1": bool}
"""Python's types of the readings' numbers."""
MAX_VALUE_DEPTH, MAX_VALUE_ITEMS, MAX_VALUE_CHARS = 3, 200, 1000
"""Largest value of a called function that is returned whole; of a larger one, its beginning."""
MAX_WHOLE_NUMBER = 2**53
"""Largest whole number that stays one in JSON everywhere."""

_program: Program | None = None
_dtypes: dict[str, str] = {}
_report_line: ReportLine | None = None


def watch(report_line: ReportLine) -> None:
    """Report lines before they run, so that the page knows which one never ends.

    Args:
        report_line: called with the number of a line.
    """
    global _report_line
    _report_line = report_line


def translate(text: str) -> str:
    """Translate the sentences of this package from now on.

    Args:
        text: JSON with the translations by the sentences in English.
    """
    translate_with(json.loads(text))
    return "{}"


def load(text: str) -> str:
    """Load a program in place of the last one.

    Args:
        text: JSON with source, outputs and readings.
    """
    global _program
    said = json.loads(text)
    output = PrintedOutput()
    _program = None
    _dtypes.clear()
    if isinstance(said.get("readings"), dict):
        _dtypes.update(said["readings"])
    outputs = {
        name: (_number(low), _number(high)) for name, (low, high) in said.get("outputs", {}).items()
    }
    try:
        _program = Program.load(
            said["source"],
            entry=said.get("entry", ""),
            outputs=outputs or None,
            output=output,
            limit_s=said.get("limit_s", DECISION_LIMIT_S),
            report_line=_report_line,
            has_entry=said.get("has_entry", True),
        )
    except ProgramError as error:
        return _failed(error, output.take())
    return json.dumps({"ok": True, "printed": output.take()})


def begin() -> str:
    """Begin an episode."""
    return _asked(lambda program: program.begin())


def decide(text: str) -> str:
    """Ask the program for a decision.

    Args:
        text: JSON with the percept.
    """
    said = json.loads(text)
    percept = {key: _reading(value, _dtypes.get(key)) for key, value in said["percept"].items()}
    return _asked(lambda program: program.decide(percept, frozenset(said.get("stops", ()))))


def call(text: str) -> str:
    """Call a function of the program.

    Args:
        text: JSON with its name, and its arguments as a JSON text.
    """
    said = json.loads(text)
    arguments = [_argument(each) for each in json.loads(said["arguments"])]
    value = ""

    def ask(program: Program) -> None:
        nonlocal value
        value = json.dumps(encoded(program.call(said["name"], arguments)))

    answer: dict[str, Any] = json.loads(_asked(ask))
    return json.dumps({**answer, "value": value} if answer["ok"] else answer)


def _argument(value: Any) -> Any:
    if isinstance(value, dict):
        if "percept" in value:
            return readings_of(value["percept"])
        return readings_of(value)["array"]
    return value


def encoded(value: Any, depth: int = MAX_VALUE_DEPTH) -> Any:
    """Return what a function returned as plain JSON.

    >>> encoded({"move": (1, float("inf"))})
    {'table': [['move', [1, {'number': 'inf'}]]]}
    >>> encoded(...), encoded({1, 2})
    ({'shown': '<ellipsis>'}, {'shown': '{1, 2}'})
    """
    if value is None or isinstance(value, bool | str):
        return value[:MAX_VALUE_CHARS] if isinstance(value, str) else value
    if isinstance(value, int) and abs(value) <= MAX_WHOLE_NUMBER:
        return int(value)
    if isinstance(value, int | float):
        try:
            number = float(value)
        except OverflowError:
            number = float("inf")
        return number if isfinite(number) else {"number": str(number)}
    is_small = depth > 0 and isinstance(value, list | tuple | dict | Reading)
    if is_small and len(value) <= MAX_VALUE_ITEMS:
        if isinstance(value, dict):
            parts = [[encoded(key, 0), encoded(each, depth - 1)] for key, each in value.items()]
            return {"table": parts}
        return [encoded(each, depth - 1) for each in value]
    return {"shown": shown(value)}


def _asked(ask: Callable[[Program], Any]) -> str:
    if _program is None or _program.output is None:
        return _failed(ProgramError(_("no program is loaded; load one first")), "")
    try:
        values = ask(_program)
    except ProgramError as error:
        return _failed(error, _program.output.take(), _program)
    answer = {"ok": True} if values is None else {"ok": True, "values": values}
    return _told(answer, _program.output.take(), _program)


def _failed(error: ProgramError, printed: str, program: Program | None = None) -> str:
    answer = {"ok": False, "text": error.text, "line": error.line, "kind": error.kind}
    return _told(answer, printed, program)


def _told(answer: dict[str, Any], printed: str, program: Program | None) -> str:
    lines = program.trace.lines if program is not None else []
    variables = program.variables() if program is not None else {}
    moments = [each._asdict() for each in program.trace.moments] if program is not None else []
    told = {**answer, "printed": printed, "lines": lines, "variables": variables}
    return json.dumps({**told, "moments": moments} if moments else told)


def _number(value: Any) -> Any:
    if isinstance(value, list):
        return [_number(each) for each in value]
    return WORDS.get(value, value) if isinstance(value, str) else value


def _reading(value: Any, dtype: str | None) -> Any:
    """Return a reading with the type that it has outside the page."""
    if isinstance(value, list):
        if dtype is None and any(isinstance(each, str) and each not in WORDS for each in value):
            return value  # texts
        return [_reading(each, dtype) for each in value]
    if dtype is None:
        return _number(value)
    cast = CASTS.get(dtype)
    return cast(_number(value)) if cast is not None else value
