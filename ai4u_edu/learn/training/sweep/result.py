"""Results of a sweep's trials, their order, and the files made of them."""

import base64
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, field_validator

from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import SetupError
from ai4u_edu.games.jobs import JobOutcome
from ai4u_edu.learn.training.run import Check
from ai4u_edu.learn.training.sweep.plan import Choice
from ai4u_edu.learn.training.sweep.search_space import text_of
from ai4u_edu.learn.training.sweep.trial import curve_of, value_of
from ai4u_edu.locale import gettext as _


class _Told(BaseModel):
    """Form of what a trial returns; see :func:`~ai4u_edu.learn.training.sweep.trial.trial`."""

    model_config = ConfigDict(extra="forbid")

    checks: Annotated[tuple[Check, ...], Field(min_length=1)]
    steps: Annotated[int, Field(ge=0)]
    pruned: bool
    network: str

    @field_validator("checks")
    @classmethod
    def _check_numbers(cls, checks: tuple[Check, ...]) -> tuple[Check, ...]:
        numbers = [n for each in checks for n in (each.success, each.reward, each.length)]
        if not all(math.isfinite(each or 0.0) for each in numbers):
            raise ValueError(_("expected finite numbers"))
        return checks


STATES = {"finished": _("finished"), "pruned": _("pruned"), "failed": _("failed")}
"""States of trials in words."""
_NOTHING = _Told.model_construct(checks=(), steps=0, pruned=False, network="")


@dataclass(frozen=True)
class TrialResult:
    """Result of one trial."""

    number: int
    choice: Choice
    checks: tuple[Check, ...]
    steps: int
    pruned: bool
    network: bytes
    """ONNX; empty if it was pruned or failed."""
    error: str
    """Sentence on why there is no result; empty if there is one."""
    seconds: float
    has_goal: bool

    @classmethod
    def of(cls, number: int, choice: Choice, outcome: JobOutcome, has_goal: bool) -> "TrialResult":
        """Return the result that a job's outcome means.

        Raises:
            SetupError: it is none of a trial, as in a journal that something else wrote.
        """
        try:
            told = _NOTHING if outcome.error else _Told.model_validate(outcome.result)
            network = base64.b64decode(told.network, validate=True)
        except ValueError as error:
            raise SetupError(
                _(
                    "trial {number}: expected the result of a training, got {problem}; the "
                    "journal in this folder is none of a sweep: choose another folder",
                    number=number,
                    problem=text_of(error),
                )
            ) from None
        return cls(
            number,
            choice,
            told.checks,
            told.steps,
            told.pruned,
            network,
            outcome.error,
            outcome.seconds,
            has_goal,
        )

    @property
    def best(self) -> Check:
        """Its best check."""
        return max(self.checks, key=lambda check: check.rank)

    @property
    def value(self) -> float:
        """Value of its best check, which the sweep maximizes."""
        return value_of(self.best, self.has_goal)

    @property
    def curve(self) -> list[float]:
        """Its evaluation curve."""
        return curve_of(self.checks, self.has_goal)

    @property
    def state(self) -> str:
        """``finished``, ``pruned`` or ``failed``."""
        return "failed" if self.error else "pruned" if self.pruned else "finished"

    @property
    def label(self) -> str:
        """Algorithm and settings in a few words."""
        chosen = (f"{name}={text_of(value)}" for name, value in self.choice.settings.items())
        return ", ".join((self.choice.algorithm, *chosen))

    def cells(self, names: Sequence[str]) -> dict[str, str]:
        """Return a table's cells by heading.

        Args:
            names: of the settings that the sweep varies.
        """
        best = self.best if self.checks else None
        success = None if best is None else best.success
        return {
            _("trial"): str(self.number),
            _("algorithm"): self.choice.algorithm,
            **{name: text_of(self.choice.settings.get(name, "")) for name in names},
            _("seed"): str(self.choice.seed),
            _("success"): "" if success is None else f"{success:.0%}",
            _("reward"): "" if best is None else f"{best.reward:.2f}",
            _("check length"): "" if best is None else f"{best.length:.1f}",
            _("at step"): "" if best is None else str(best.steps),
            _("steps"): str(self.steps or ""),
            _("state"): STATES[self.state],
        }


def ranked(results: Sequence[TrialResult]) -> list[TrialResult]:
    """Return results in order, the best one first: by their best checks, then the faster one."""

    def key(result: TrialResult) -> tuple[bool, bool, tuple[float, float], int, int]:
        has_checks = bool(result.checks)
        rank = result.best.rank if has_checks else (0.0, 0.0)
        at = result.best.steps if has_checks else 0
        return has_checks, bool(result.network), rank, -at, -result.number

    return sorted(results, key=key, reverse=True)


def groups(results: Sequence[TrialResult]) -> list[dict[str, str]]:
    """Return a row for each algorithm with its settings, over all seeds; the best one first."""
    found: dict[str, list[TrialResult]] = {}
    for each in results:
        if each.checks:
            found.setdefault(each.label, []).append(each)
    order = sorted(found.items(), key=lambda pair: -float(np.mean([e.value for e in pair[1]])))
    rows: list[dict[str, str]] = []
    for label, members in order:
        values = [each.value for each in members]
        sign = "{:.0%}" if members[0].has_goal else "{:.2f}"
        rows.append(
            {
                _("settings"): label,
                _("seeds"): str(len(values)),
                _("mean"): sign.format(np.mean(values)),
                _("worst"): sign.format(min(values)),
                _("best"): sign.format(max(values)),
            }
        )
    return rows


def csv_text(results: Sequence[TrialResult], names: Sequence[str]) -> str:
    """Return all trials as CSV, with full numbers and the evaluation curve's points."""
    head = "trial algorithm", "seed state success reward length", "best_at_step steps seconds"
    first, middle, last = (each.split() for each in head)
    header = [*first, *names, *middle, *last, "curve", "error"]
    return csv_table(header, (_row(each, names) for each in results))


def _row(result: TrialResult, names: Sequence[str]) -> list[object]:
    told = ["", "", "", ""]
    if result.checks:
        best = result.best
        success = "" if best.success is None else best.success
        told = [str(v) for v in (success, best.reward, best.length, best.steps)]
    choice = result.choice
    return [
        *(result.number, choice.algorithm),
        *(_full(choice.settings.get(name, "")) for name in names),
        *(choice.seed, result.state, *told, result.steps, f"{result.seconds:.1f}"),
        " ".join(f"{v:.6g}" for v in (result.curve if result.checks else ())),
        result.error,
    ]


def _full(value: object) -> object:
    return text_of(value) if isinstance(value, list) else value
