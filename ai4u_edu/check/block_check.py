"""What is looked at in a run, whatever the block."""

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Record, Script, Trial, standard_scene
from ai4u_edu.scenes import Scene

DECISIONS = 120
"""How long a run is, unless told otherwise."""

LONGEST = 120
"""So many characters of a value are shown."""


@dataclass
class Options:
    """Where, how and for how long something is driven."""

    scene: Scene | str | None = None
    script: Script | None = None
    seed: int = 0
    decisions: int = DECISIONS

    def the_scene(self) -> Scene:
        """The scene that was given, or the standard one."""
        if isinstance(self.scene, str):
            return Scene.load(self.scene)
        return self.scene or standard_scene()


class Exam:
    """Runs something, and looks at what every run has to be like.

    Args:
        report: where the findings go.
        make: makes a new trial, each time with new blocks.
        options: the seed and the length of the runs.
        of: what in a record is looked at, such as a sensor's reading.
        words: what that is called, such as "readings".
    """

    def __init__(
        self,
        report: Report,
        make: Callable[[], Trial],
        options: Options,
        *,
        of: Callable[[Record], Any],
        words: str,
    ) -> None:
        self.report = report
        self._make, self._of, self._words = make, of, words
        self._seed, self._decisions = options.seed, options.decisions
        self.records: list[Record] = []
        """What the first run gave."""

    def run(self, *, forgets: str = "") -> bool:
        """Sets up and drives, more than once; whether it could be driven at all.

        Args:
            forgets: why a reset need not forget everything, if so.
        """
        before = global_chance()
        try:
            trial = self._make()
        except Exception as error:  # whatever it is, the report says it
            self.report.add("setup", f"expected a setup without an error, got {said(error)}")
            return False
        self.report.add("setup")
        self.view = trial.agent.view  # the world that was built for the first run
        try:
            self.records = self.drive(trial)
        except Exception as error:  # whatever it is, the report says it
            text = f"expected {self._decisions} decisions without an error, got {said(error)}"
            self.report.add("runs", text)
            return False
        self.report.add("runs")
        drawn = [name for name, state in global_chance().items() if state != before[name]]
        self.report.add(
            "global chance",
            f"expected no draw from a global generator, got one from {' and '.join(drawn)}; "
            "take view.random(name), which grows from the world's seed"
            if drawn
            else "",
        )
        self._same_twice()
        self._forgets(trial, forgets)
        return True

    def drive(self, trial: Trial) -> list[Record]:
        """One run."""
        return trial.run(self._seed, self._decisions)

    def values(self) -> list[Any]:
        """What is looked at, of the first run."""
        return [self._of(record) for record in self.records]

    def changes(self, *, warning: bool) -> None:
        """Looks whether it is ever different.

        Args:
            warning: whether that is no failure.
        """
        # at a reset nothing is paid or answered
        values = [value for value in self.values() if value is not None]
        same = all(frozen(value) == frozen(values[0]) for value in values)
        got = f"{short(values[0])} all {len(values)} times" if values else "none"
        self.report.add(
            "changes",
            f"expected {self._words} that change while the agent drives about, got {got}; "
            "if there is nothing here to make them change, check it in another scene, by scene=..."
            if same
            else "",
            outcome=Outcome.WARNING if same and warning else None,
        )

    def only_looks(self, without: Trial) -> None:
        """Looks whether the world goes on as it does without the block, for an episode."""
        problem = ""
        for number, (one, other) in enumerate(zip(self.records, self.drive(without), strict=False)):
            moved = [name for name in one.poses if one.poses[name] != other.poses[name]]
            if moved:
                problem = (
                    "expected the world to go on as it does without it, got body "
                    f"{moved[0]!r} at another place after decision {number}; what only looks "
                    "must not move anything"
                )
            if moved or one.done or other.done:
                break  # an end that a reward asked for is no move, and after it nothing compares
        self.report.add("only looks", problem)

    def _same_twice(self) -> None:
        problem = self._difference(lambda: self.drive(self._make()))
        self.report.add(
            "same twice",
            f"expected the same {self._words} from the same seed, got {problem}; "
            "take chance from view.random(name), and go through no set"
            if problem
            else "",
        )

    def _forgets(self, trial: Trial, why_not: str) -> None:
        if self.report.findings[-1].outcome is Outcome.FAILED:
            why_not = "it differs even without a reset"
        if why_not:
            self.report.add("forgets", why_not, outcome=Outcome.NOT_APPLICABLE)
            return
        problem = self._difference(lambda: self.drive(trial))
        self.report.add(
            "forgets",
            f"expected the same {self._words} again after a reset, got {problem}; "
            "put back in on_reset whatever changes in an episode"
            if problem
            else "",
        )

    def _difference(self, run: Callable[[], list[Record]]) -> str:
        """Where another run first differs from the first one; empty if nowhere."""
        try:
            others = run()
        except Exception as error:  # whatever it is, the report says it
            return said(error)
        for number, (one, other) in enumerate(zip(self.records, others, strict=False)):
            expected, got = self._of(one), self._of(other)
            if frozen(expected) != frozen(got):
                return f"{short(got)} in place of {short(expected)} after decision {number}"
        return "" if len(others) == len(self.records) else "episodes of other lengths"


def global_chance() -> dict[str, str]:
    """The states of Python's and numpy's global generators."""
    _, state, *rest = np.random.get_state(legacy=True)
    return {
        "random": repr(random.getstate()),
        "numpy.random": repr((np.asarray(state).tobytes(), rest)),
    }


def frozen(value: Any) -> Any:
    """Something that is equal for values that are the same to the last bit, and no others."""
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    return repr(value)


def short(value: Any) -> str:
    """A value in at most a line."""
    text = str(value.tolist()) if isinstance(value, np.ndarray) else str(value)
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."


def said(error: Exception) -> str:
    """What an error says, with its kind and its notes."""
    return "; ".join([f"{type(error).__name__}: {error}", *getattr(error, "__notes__", [])])
