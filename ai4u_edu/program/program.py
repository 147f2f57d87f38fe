"""A program that is loaded once, and then asked for one decision after another."""

import ast
import builtins
import math
from collections.abc import Callable, Mapping, Sequence, Set
from typing import Any, Self

from ai4u_edu.program import standins
from ai4u_edu.program.endless import loop_around, why_endless
from ai4u_edu.program.mistakes import NOTHING_RETURNED, ProgramError, mistake_in
from ai4u_edu.program.output import PrintedOutput
from ai4u_edu.program.portable import obstacle_in_tree
from ai4u_edu.program.reading import Reading, plain_sum, readings_of
from ai4u_edu.program.texts import gettext as _
from ai4u_edu.program.tracing import DECISION_LIMIT_S, EndlessError, ReportLine, Trace
from ai4u_edu.program.words import nearest, shown, suggest

_DIGITS = 9
"""Digits behind the point to which a decision's numbers are rounded. Functions such as sin and
atan2 differ by one unit in the last place between the page and other machines; rounded, decisions
are the same everywhere."""

Outputs = Mapping[str, tuple[Sequence[float], Sequence[float]]]
"""Lowest and highest values of each number, by the actuator's name."""


def _checked_action(answer: Any, outputs: Outputs | None, line: int = 0) -> dict[str, list[float]]:
    """Return a program's answer as numbers by the actuator's name.

    Numbers out of range stay as they are: the actuator clips them.

    Args:
        answer: the value that the program returned.
        outputs: the agent's actuators; None checks neither names nor counts.
        line: of the program, that returned it.

    Raises:
        ProgramError: it is no action of this agent.

    >>> _checked_action({"move": (1, 0.5)}, {"move": ([-1, -1], [1, 1])})
    {'move': [1.0, 0.5]}
    >>> _checked_action({"mov": [1, 0.5]}, {"move": ([-1, -1], [1, 1])}, 3)
    Traceback (most recent call last):
    ai4u_edu.program.mistakes.ProgramError: line 3: the robot can't do 'mov'; did you mean 'move'?
    """
    if answer is None:
        raise ProgramError(_(NOTHING_RETURNED), line, "no-return")
    if not isinstance(answer, Mapping):
        text = _(
            "expected an action like {example}, got {got}",
            example=_example(outputs),
            got=shown(answer),
        )
        raise ProgramError(text, line, "action")
    return {name: _numbers(name, answer[name], outputs, line) for name in answer}


def _numbers(name: Any, value: Any, outputs: Outputs | None, line: int) -> list[float]:
    count = None
    if outputs is not None:
        if not isinstance(name, str) or name not in outputs:
            # others take no numbers, and the page does not list them
            known = [each for each, (low, _high) in outputs.items() if len(low)]
            raise ProgramError(_unknown_actuator(name, known, outputs), line, "actuator")
        count = len(outputs[name][0])
    wanted = _("numbers")
    if count is not None:
        wanted = _("1 number") if count == 1 else _("{count} numbers", count=count)
    if hasattr(value, "tolist") and not isinstance(value, Reading):
        value = value.tolist()
    values = list(value) if isinstance(value, list | tuple | Reading) else [value]
    for each in values:
        if each is None or not isinstance(each, int | float):
            text = _(
                "action {name!r}: {advice}",
                name=name,
                advice=_advice(each, value, wanted, _example(outputs, name)),
            )
            raise ProgramError(text, line, "not-a-number")
    if count is not None and len(values) != count:
        text = _(
            "action {name!r}: expected {wanted}, got {count}: {got}; write, say, {example}",
            name=name,
            wanted=wanted,
            count=len(values),
            got=shown(value),
            example=_example(outputs, name),
        )
        raise ProgramError(text, line, "length")
    try:
        numbers = [float(each) for each in values]
    except OverflowError:
        numbers = [math.inf]
    if not all(map(math.isfinite, numbers)):
        text = _(
            "action {name!r}: expected finite numbers, got {got}; inf and nan come from sums and "
            "quotients without a value",
            name=name,
            got=shown(value),
        )
        raise ProgramError(text, line, "not-finite")
    return [round(each, _DIGITS) for each in numbers]


def _unknown_actuator(name: Any, known: Sequence[str], outputs: Outputs) -> str:
    """Return what is wrong with a name that no actuator has, and how to mend it."""
    wrong, example = shown(name), _example(outputs)
    if nearest(str(name), known):
        hint = suggest(str(name), known)
        return _("the robot can't do {name}; {hint}", name=wrong, hint=hint)
    if len(known) == 1:
        return _("the robot can't do {name}; write, say, {example}", name=wrong, example=example)
    return _(
        "the robot can't do {name}; {hint}; write, say, {example}",
        name=wrong,
        hint=suggest(str(name), known),
        example=example,
    )


def _advice(part: Any, value: Any, wanted: str, example: str) -> str:
    """Return what is wrong with a part of a value that is no number, and how to mend it."""
    if isinstance(part, str):
        try:
            return _(
                "{text} is text. Write {number:g} without quotes.",
                text=shown(part),
                number=float(part),
            )
        except ValueError:
            return _("{text} is text. Expected a number, without quotes.", text=shown(part))
    if part is None:
        return _(
            "expected {wanted}, got {part} in {value}; None means that a function returned "
            "nothing, or that nothing was computed yet",
            wanted=wanted,
            part=shown(part),
            value=shown(value),
        )
    return _(
        "expected {wanted}, got {part} in {value}; write, say, {example}",
        wanted=wanted,
        part=shown(part),
        value=shown(value),
        example=example,
    )


def _example(outputs: Outputs | None, name: str = "") -> str:
    numbered = {each: low for each, (low, _high) in (outputs or {}).items() if len(low)}
    if not numbered:
        return _('{"move": [forward, turn, 0, 0]}')
    name = name if name in numbered else next(iter(numbered))
    low = numbered[name]
    values = ", ".join(["1", *["0"] * (len(low) - 1)][: len(low)])
    return f'{{"{name}": [{values}]}}'


MAX_SOURCE_CHARS = 200_000
_ENTRY = "decide"
"""Name of the function that is asked, if no other is named."""
_METHOD = "get_action"
_MODULE_NAME = "program"
"""Name of a program's module, as it is in ``__name__``."""
_VARARGS = 0x04
"""Flag of a function with ``*arguments``; to import inspect for it takes long in a browser."""


class Program:
    r"""A student's program: a function ``decide(percept)``, or a class with ``get_action``.

    Its global variables are made again by each :meth:`load`; a new episode leaves them as they are,
    as it does for a function that drives a LocalBrain. A class is made once, and its ``reset()``
    and a Controller's ``on_reset(agent, view)`` are called at each episode's begin; agent and view
    are None. One thread calls all methods.

    Attributes:
        trace: what ran in the last call.
        output: what was printed; None if the program prints as Python does.

    >>> program = Program.load(
    ...     "def decide(percept):\n    return {'move': [percept['eyes'].max(), 0]}",
    ...     outputs={"move": ([-1, -1], [1, 1])},
    ... )
    >>> program.begin()
    >>> program.decide({"eyes": [0.25, 0.5]})
    {'move': [0.5, 0.0]}
    """

    def __init__(
        self,
        tree: ast.Module,
        file: str,
        *,
        outputs: Outputs | None,
        output: PrintedOutput | None,
        trace: Trace,
    ) -> None:
        self.trace = trace
        self.output = output
        self._tree = tree
        self.file = file
        self._outputs = outputs
        self._is_deciding = False
        self._quoted: Set[str] = frozenset(outputs or ())
        self._controller: Any = None
        self._function: Callable[[Any], Any] = lambda percept: None  # noqa: ARG005  # until it is loaded
        self._names: dict[str, Any] = {}

    @classmethod
    def load(
        cls,
        source: str,
        file: str = "program.py",
        entry: str = "",
        outputs: Outputs | None = None,
        *,
        output: PrintedOutput | None = None,
        limit_s: float = DECISION_LIMIT_S,
        keeps_lines: bool = True,
        report_line: ReportLine | None = None,
        has_entry: bool = True,
    ) -> Self:
        """Run a program's text, and find the function that decides.

        Args:
            source: the text.
            file: name for tracebacks.
            entry: name of a function, of a class with ``get_action`` or of such an object; by
                default ``decide``, else the only class with ``get_action``.
            outputs: lowest and highest values of the agent's actuators by name; None checks
                neither names nor counts.
            output: keeps what is printed; by default it is printed as Python does.
            limit_s: longest time of a decision, and of loading, seconds.
            keeps_lines: True records lines and variables of each decision.
            report_line: called with lines before they run.
            has_entry: False for a text with functions to :meth:`call`, none of which decides.

        Raises:
            ProgramError: a mistake, with its line.
        """
        trace = Trace(file, limit_s, keeps_lines=keeps_lines, report_line=report_line)
        tree = _parsed(source, file)
        # before anything runs: the program must be one that the page and a script can run
        obstacle = obstacle_in_tree(tree)
        if obstacle is not None:
            raise obstacle
        program = cls(tree, file, outputs=outputs, output=output, trace=trace)
        program._run_module()
        if has_entry:
            program._find_entry(entry)
        return program

    def begin(self) -> None:
        """Begin an episode.

        Raises:
            ProgramError: a mistake in the controller's ``reset``.
        """
        self._call_hook("reset")
        self._call_hook("on_reset", None, None)

    def decide(
        self, percept: Mapping[str, Any], stops: Set[int] = frozenset()
    ) -> dict[str, list[float]]:
        """Return the program's action for a percept: numbers by the actuator's name.

        Args:
            percept: readings by key, as :func:`~ai4u_edu.program.readings_of` takes them.
            stops: lines from the first of which on the trace keeps the moments.

        Raises:
            ProgramError: a mistake, with its line.
        """
        readings = readings_of(percept)
        self._quoted = {*readings, *(self._outputs or ())}
        self._is_deciding = True
        try:
            self._call_hook("new_state_event", readings)
            self.trace.stops = stops
            answer = self._call(self._function, readings)
        finally:
            self.trace.stops = frozenset()
            self._is_deciding = False
        return _checked_action(answer, self._outputs, self.trace.last_line or self._first_line())

    def call(self, name: str, arguments: Sequence[Any]) -> Any:
        """Call one of the program's functions, with the limits and the trace of a decision.

        Args:
            name: of the function.
            arguments: numbers, bools, texts, lists of them, or readings.

        Raises:
            ProgramError: a mistake, with its line.
        """
        value = self._names.get(name)
        if not callable(value) or isinstance(value, type) or name.startswith("__"):
            own = [
                each
                for each, one in self._names.items()
                if getattr(one, "__module__", "") == _MODULE_NAME
            ]
            hint = suggest(name, own)
            text = _("there is no function {name!r}; {hint}", name=name, hint=hint)
            raise ProgramError(text, 0, "entry")
        code = getattr(value, "__code__", None)
        wanted = getattr(code, "co_argcount", len(arguments))
        if wanted != len(arguments) and not getattr(code, "co_flags", 0) & _VARARGS:
            text = _(
                "{name} is called with {count} values, and takes {wanted}",
                name=name,
                count=len(arguments),
                wanted=wanted,
            )
            raise ProgramError(text, self._line_of(name), "parameters")
        return self._call(value, *arguments)

    def variables(self) -> dict[str, str]:
        """Return the variables at the end of the last call: names, and beginnings of values."""
        return self.trace.variables(self._names)

    def _run_module(self) -> None:
        own = {"__import__": _import, "sum": plain_sum, "input": _no_input}
        if self.output is not None:
            own["print"] = self.output.print
        self._names = {
            "__builtins__": {**vars(builtins), **own},
            "__name__": _MODULE_NAME,
            "__file__": self.file,
        }
        try:
            code = compile(_CatchesLess().visit(self._tree), self.file, "exec")
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise mistake_in(error, self.file) from None
        self._call(exec, code, self._names)

    def _find_entry(self, entry: str) -> None:
        value = self._names[self._entry_name(entry)]
        if isinstance(value, type):
            value = self._call(value)
        if hasattr(value, _METHOD):
            self._controller = value
            self._call_hook("on_setup", None, None)
            value = getattr(value, _METHOD)
        _check_parameters(value)
        self._function = value

    def _entry_name(self, entry: str) -> str:
        """Return the name of the function, class with ``get_action`` or such object that is asked.

        Args:
            entry: the name that was asked for; empty for ``decide``, else the only class with
                ``get_action``.

        Raises:
            ProgramError: there is none, or it can't be asked.
        """
        name = entry or self._only_entry()
        if name not in self._names or name.startswith("__"):
            known = [each for each in self._names if not each.startswith("_")]
            hint = suggest(name, known)
            text = _("{file} has no {name!r}; {hint}", file=self.file, name=name, hint=hint)
            raise ProgramError(text, 0, "entry")
        value, line = self._names[name], self._line_of(name)
        if isinstance(value, type) and not callable(getattr(value, _METHOD, None)):
            text = _(
                "the class {name} has no {method}(self, percept): it must return an action",
                name=name,
                method=_METHOD,
            )
            raise ProgramError(text, line, "entry")
        if not callable(value) and not callable(getattr(value, _METHOD, None)):
            text = _(
                "{name!r} is no function; expected a function: def decide(percept):", name=name
            )
            raise ProgramError(text, line, "entry")
        return name

    def _only_entry(self) -> str:
        if _ENTRY in self._names:
            return _ENTRY
        # of this program, and not what it imported
        own = {
            name: value
            for name, value in self._names.items()
            if getattr(value, "__module__", "") == _MODULE_NAME
        }
        classes = [
            name for name, each in own.items() if isinstance(each, type) and hasattr(each, _METHOD)
        ]
        if len(classes) == 1:
            return classes[0]
        near = nearest(_ENTRY, own)
        if near:
            text = _(
                "the function must be called {name}, exactly so; you wrote {near}",
                name=_ENTRY,
                near=near,
            )
            raise ProgramError(text, self._line_of(near), "entry")
        text = _(
            "there is no function {name!r}; expected a function: def decide(percept):", name=_ENTRY
        )
        raise ProgramError(text, 0, "entry")

    def _line_of(self, name: str) -> int:
        """Return the line in which a name of the module is defined; 0 if it is not found."""
        for node in self._tree.body:
            if getattr(node, "name", "") == name:
                return node.lineno
            targets = node.targets if isinstance(node, ast.Assign) else ()
            if any(isinstance(each, ast.Name) and each.id == name for each in targets):
                return node.lineno
        return 0

    def _call_hook(self, name: str, *arguments: Any) -> None:
        """Call a method that a controller may have; the stand-in's own ones do nothing."""
        method = getattr(self._controller, name, None)
        if callable(method) and getattr(method, "__module__", "") != standins.__name__:
            self._call(method, *arguments)

    def _first_line(self) -> int:
        code = getattr(self._function, "__code__", None)
        return code.co_firstlineno if code is not None else 0

    def _call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        try:
            return self.trace.run(function, *arguments)
        except EndlessError as error:
            raise self._endless(error.line) from None
        # exit() in a program ends its decision, and not the process; Ctrl-C passes
        except (Exception, SystemExit) as error:
            raise mistake_in(error, self.file, self._quoted) from error

    def _endless(self, line: int) -> ProgramError:
        loop = loop_around(self._tree, line)
        why = why_endless(loop, is_in_decision=self._is_deciding)
        seconds = self.trace.limit_s
        if seconds == 1:
            text = _("Your code has been running for 1 second without an answer. {why}", why=why)
        else:
            text = _(
                "Your code has been running for {seconds:g} seconds without an answer. {why}",
                seconds=seconds,
                why=why,
            )
        return ProgramError(text, loop.lineno if loop else line, "endless")


class _CatchesLess(ast.NodeTransformer):
    """Lets a bare ``except`` catch no error that ends an endless loop."""

    def visit_ExceptHandler(self, node: ast.ExceptHandler) -> ast.AST:
        self.generic_visit(node)
        if node.type is None or (
            isinstance(node.type, ast.Name) and node.type.id == "BaseException"
        ):
            node.type = ast.copy_location(ast.Name("Exception", ast.Load()), node)
        return node


def _parsed(source: str, file: str) -> ast.Module:
    if len(source) > MAX_SOURCE_CHARS:
        raise ProgramError(
            _("expected a program of at most {count:,} characters", count=MAX_SOURCE_CHARS)
        )
    try:
        return ast.parse(source, file)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise mistake_in(error, file) from None


def _import(name: str, *arguments: Any, **options: Any) -> Any:
    if name == "ai4u_edu":
        return standins.MODULE
    return builtins.__import__(name, *arguments, **options)


def _no_input(*_prompt: object) -> None:
    raise ProgramError(
        _(
            "input() doesn't work here: the program only knows what the robot senses. Use what "
            "percept has, or write the value into the program."
        )
    )


def _check_parameters(function: Any) -> None:
    """Raise a ProgramError unless a function can be called with the percept alone."""
    code = getattr(getattr(function, "__func__", function), "__code__", None)
    if code is None or code.co_flags & _VARARGS:
        return
    is_method = hasattr(function, "__self__")
    optional = len(function.__defaults__ or ())
    if not code.co_argcount - optional <= 1 + is_method <= code.co_argcount:
        name = code.co_name
        if is_method:
            text = _("{name} must take self and the percept: def {name}(self, percept):", name=name)
        else:
            text = _("{name} must take one value, the percept: def {name}(percept):", name=name)
        raise ProgramError(text, code.co_firstlineno, "parameters")
