"""Proposals for trials by Optuna: ask for a batch, tell the results, ask for the next one."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import optuna
from optuna.storages.journal import JournalFileBackend

from ai4u_edu.learn.training.sweep.plan import Choice, SweepPlan
from ai4u_edu.learn.training.sweep.result import TrialResult
from ai4u_edu.learn.training.sweep.search_space import Parameter, Value

FILE = "optuna.log"
SEED = 0
"""Seed of the proposals."""


class OptunaSearch:
    """Proposes a sweep's trials, batch by batch.

    Proposals depend on the plan and on the results told so far, and on nothing else: the same
    sweep proposes the same trials on every engine, and again when it goes on. So the study is
    written anew at each start, and the sweep's own journal is what is kept.

    Args:
        plan: the sweep's plan.
        folder: gets the study in Optuna's journal format, for tools such as optuna-dashboard.
    """

    def __init__(self, plan: SweepPlan, folder: Path) -> None:
        optuna.logging.set_verbosity(optuna.logging.ERROR)
        self._plan = plan
        path = folder / FILE
        path.unlink(missing_ok=True)
        self._study = optuna.create_study(
            study_name=str(plan.scene["name"]),
            direction="maximize",
            storage=optuna.storages.JournalStorage(JournalFileBackend(str(path))),
            sampler=optuna.samplers.TPESampler(seed=SEED, n_startup_trials=max(10, plan.batch)),
        )
        self._asked: list[optuna.Trial] = []

    def ask(self, count: int) -> list[Choice]:
        """Return the next trials to run."""
        first = len(self._study.get_trials(deepcopy=False))
        self._asked = [self._study.ask() for _ in range(count)]
        seeds = self._plan.seeds
        return [
            self._choice(trial, seeds[(first + place) % len(seeds)])
            for place, trial in enumerate(self._asked)
        ]

    def tell(self, results: Sequence[TrialResult]) -> None:
        """Tell the results of the trials that were asked for, in their order."""
        states = optuna.trial.TrialState
        for trial, result in zip(self._asked, results, strict=True):
            if result.error:
                self._study.tell(trial, state=states.FAIL)
                continue
            for step, value in enumerate(result.curve[: len(result.checks)]):
                trial.report(value, step)
            trial.set_user_attr("seed", result.choice.seed)
            if result.pruned:
                self._study.tell(trial, state=states.PRUNED)
            else:
                self._study.tell(trial, result.value)

    def _choice(self, trial: optuna.Trial, seed: int) -> Choice:
        algorithm: Any = trial.suggest_categorical("algorithm", self._plan.algorithms)
        chosen = {
            each.name: _suggested(trial, each)
            for each in self._plan.parameters
            if each.is_for(algorithm)
        }
        return Choice(algorithm=algorithm, seed=seed, settings=chosen)


def _suggested(trial: optuna.Trial, parameter: Parameter) -> Value:
    name = parameter.name
    if not parameter.is_range:
        # by their places, as Optuna wants no lists
        places = range(len(parameter.values))
        place = int(trial.suggest_categorical(name, [*places]))
        return parameter.values[place]
    if parameter.is_whole:
        low, high = int(parameter.low), int(parameter.high)
        return trial.suggest_int(name, low, high, log=parameter.is_log)
    return trial.suggest_float(name, parameter.low, parameter.high, log=parameter.is_log)
