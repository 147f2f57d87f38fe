"""Plan of a sweep: all that its results depend on, kept in its folder."""

import math
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.parameters import explain, format_problems
from ai4u_edu.games.jobs import Job
from ai4u_edu.learn.training.settings import Algorithm, AlgorithmSettings, Settings
from ai4u_edu.learn.training.sweep.search_space import Parameter, Value, changes_of, grid
from ai4u_edu.learn.training.sweep.trial import CHECKS, trial
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.scene_data import scene_from

FILE = "sweep.json"
PPO_STEPS = 2048
"""Decisions of a world in a rollout of PPO, where the settings say nothing else."""
MAX_ROUNDING = 2
"""Factor by which the steps may grow so that all trials have the same number of them."""


class Choice(BaseModel):
    """Choices that a trial is made of."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    algorithm: Algorithm
    seed: int
    settings: dict[str, Value]
    """Values of the parameters, by their names."""


class SweepPlan(BaseModel):
    """Scene, settings, seeds and trials of a sweep."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    scene: dict[str, Any]
    """See :func:`ai4u_edu.scenes.scene_data.scene_data`."""
    algorithms: tuple[Algorithm, ...]
    seeds: tuple[int, ...]
    parameters: tuple[Parameter, ...]
    trials: int
    """Number of trials that Optuna proposes; 0 for all combinations."""
    batch: int
    """Trials that are proposed at once; more of them keep more cores busy, and know less."""
    steps: int | None
    """Decisions of a trial; None for as many as the settings say."""
    settings: dict[str, Any]
    """Settings that all trials share, complete."""

    @property
    def is_search(self) -> bool:
        """True if Optuna proposes the trials."""
        return self.trials > 0

    @property
    def has_goal(self) -> bool:
        """True if the scene defines a success."""
        return scene_from(self.scene).description.success is not None

    def choices(self) -> list[Choice]:
        """Return all combinations of algorithms, values and seeds."""
        return [
            Choice(algorithm=algorithm, seed=seed, settings=chosen)
            for algorithm in self.algorithms
            for chosen in grid(self.parameters, algorithm)
            for seed in self.seeds
        ]

    def job(self, choice: Choice, rivals: list[list[float]] | None = None) -> Job:
        """Return the job of a trial.

        Raises:
            SetupError: a value is none that its setting may have.
        """
        changes = changes_of(choice.algorithm, choice.settings)
        own = {**self.settings[choice.algorithm], **changes.pop(choice.algorithm)}
        budget = self.steps or int(own["steps"])
        own |= {"steps": budget, "check_every": max(1, budget // CHECKS)}
        given = {**self.settings, **changes, choice.algorithm: own}
        try:
            settings = Settings.model_validate(given)
        except ValidationError as error:
            problems = format_problems(explain(error.errors(), Settings))
            raise SetupError(_("--set: {problems}", problems=problems)) from None
        return Job.of(
            trial,
            scene=self.scene,
            algorithm=choice.algorithm,
            settings=settings.model_dump(mode="json"),
            seed=choice.seed,
            budget=budget,
            rivals=rivals or [],
        )

    def with_equal_budgets(self) -> "SweepPlan":
        """Return the plan with steps that all trials can learn from to the last one.

        PPO learns from the decisions of a whole rollout at once, and would take the rest of the
        last one beyond its budget, where others end; so the steps of all are rounded up.
        """
        if self.steps is None or self.is_search or "ppo" not in self.algorithms:
            return self
        rollouts = [_rollout(self.job(each)) for each in self._kinds() if each.algorithm == "ppo"]
        unit = math.lcm(*rollouts)
        steps = math.ceil(self.steps / unit) * unit
        is_near = steps <= MAX_ROUNDING * max(self.steps, *rollouts)
        return self.model_copy(update={"steps": steps}) if is_near else self

    def _kinds(self) -> list[Choice]:
        """Return choices with all values, or with some of them if there are ranges; on one seed."""
        if not self.is_search:
            return [each for each in self.choices() if each.seed == self.seeds[0]]
        return [self._first_choice(algorithm) for algorithm in self.algorithms]

    def _first_choice(self, algorithm: Algorithm) -> Choice:
        chosen = {
            each.name: each.values[0] if each.values else _end(each)
            for each in self.parameters
            if each.is_for(algorithm)
        }
        return Choice(algorithm=algorithm, seed=self.seeds[0], settings=chosen)

    def unlike_budgets(self) -> str:
        """Return a sentence if trials learn from different numbers of decisions; else nothing."""
        budgets: dict[str, set[int]] = {}
        for algorithm in self.algorithms:
            seen = budgets.setdefault(algorithm, set())
            for each in self._kinds():
                if each.algorithm != algorithm:
                    continue
                job = self.job(each)
                budget, unit = int(job.arguments["budget"]), _rollout(job)
                seen.add(math.ceil(budget / unit) * unit)
        if len(set[int]().union(*budgets.values())) < 2:
            return ""
        told = "; ".join(
            f"{name}: {' / '.join(f'{each:,}' for each in sorted(seen))}"
            for name, seen in budgets.items()
        )
        return _(
            "Trials learn from different numbers of decisions, which is no fair race: {told}",
            told=told,
        )

    def check(self) -> None:
        """Check the settings before anything runs.

        Raises:
            SetupError: one of them is unknown, or there is nothing to do.
        """
        from ai4u_edu.learn.training.algorithms import checked_options

        unlisted = [str(each) for each in self.parameters if each.is_range]
        if unlisted and not self.is_search:
            raise SetupError(
                _(
                    "--set {unlisted}: a range has too many values to try all; expected "
                    "--trials, the number of trials, or values as in NAME=0.001,0.01",
                    unlisted=unlisted[0],
                )
            )
        for algorithm in self.algorithms:
            job = self.job(self._first_choice(algorithm))
            own = AlgorithmSettings.model_validate(job.arguments["settings"][algorithm])
            checked_options(algorithm, own)

    def save(self, folder: Path) -> None:
        """Write the plan into a sweep's folder."""
        make_folder(folder, _("a sweep"))
        write_atomically(folder / FILE, self.model_dump_json(indent=1) + "\n")

    @classmethod
    def load(cls, folder: Path) -> "SweepPlan":
        """Read the plan of a sweep's folder.

        Raises:
            SetupError: there is no sweep in the folder.
        """
        path = folder / FILE
        try:
            return cls.model_validate_json(path.read_bytes())
        except OSError:
            raise SetupError(
                _(
                    "{folder} holds no sweep; begin one with: ai4u-edu sweep SCENE --out {folder}",
                    folder=str(folder),
                )
            ) from None
        except ValidationError as error:
            raise SetupError(
                _(
                    "{path}: not as a sweep writes it: {problem}",
                    path=str(path),
                    problem=format_problems(explain(error.errors(), cls)),
                )
            ) from None

    def difference(self, other: "SweepPlan") -> str:
        """Return the name of a part that differs; empty if one goes on where the other ended."""
        for name in type(self).model_fields:
            if name == "trials" and self.is_search == other.is_search:
                continue  # more trials may follow
            if getattr(self, name) != getattr(other, name):
                return name
        return ""


def _rollout(job: Job) -> int:
    """Return the number of decisions after which a trial may end."""
    if job.arguments["algorithm"] != "ppo":
        return 1
    own = job.arguments["settings"]["ppo"]
    return int(own.get("n_steps", PPO_STEPS)) * int(own["worlds"])


def _end(parameter: Parameter) -> Value:
    return int(parameter.low) if parameter.is_whole else parameter.low
