"""A run of a sweep: its trials on an engine, and the files in its folder.

::

    DIR/sweep.json      the plan
    DIR/journal.jsonl   the results of all trials; a sweep goes on from it
    DIR/optuna.log      the study, for Optuna's tools
    DIR/networks/       the best network of each trial
    DIR/best.onnx       the best of all
    DIR/trials.csv, parallel.png, curves.png, index.html
    DIR/terms.png       how it learned without each reward term, if that was tried
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.optional_deps import need
from ai4u_edu.games.jobs import Engine, Journal, run_jobs
from ai4u_edu.learn.training.evaluating import Evaluation, evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.sweep.page import draw_pictures, page_of
from ai4u_edu.learn.training.sweep.plan import Choice, SweepPlan
from ai4u_edu.learn.training.sweep.result import TrialResult, csv_text, ranked
from ai4u_edu.learn.training.sweep.search_space import Parameter, Value
from ai4u_edu.scenes.scene_data import scene_from

if TYPE_CHECKING:
    import optuna

NETWORKS = "networks"
BEST = "best.onnx"
PAGE = "index.html"
STUDY = "optuna.log"


@dataclass(frozen=True)
class Sweep:
    """Results of a sweep so far."""

    plan: SweepPlan
    folder: Path
    results: tuple[TrialResult, ...]
    """Results of the trials that ended, by number."""
    is_interrupted: bool
    evaluation: Evaluation | None = None
    """Evaluation of the best network on seeds that no training or check used; None if the sweep
    was interrupted or no trial finished."""

    @property
    def best(self) -> TrialResult | None:
        """The best finished trial."""
        return next((each for each in ranked(self.results) if each.network), None)


def total_of(plan: SweepPlan) -> int:
    """Return the number of trials of a plan."""
    return plan.trials or len(plan.choices())


def run_sweep(
    plan: SweepPlan,
    folder: Path,
    engine: Engine,
    *,
    tell: Callable[[TrialResult], object] = lambda _result: None,
) -> Sweep:
    """Run the trials of a plan that have not been run; Ctrl-C keeps those that are finished.

    Args:
        plan: the plan.
        folder: a sweep's folder, with the plan in it.
        engine: runs the trials.
        tell: called with the result of each trial when it ends.
    """
    results: list[TrialResult] = []
    interrupted = False

    def take(result: TrialResult) -> None:
        results.append(result)
        if result.network:
            path = folder / NETWORKS / f"trial-{result.number:03}.onnx"
            path.parent.mkdir(exist_ok=True)
            write_atomically(path, result.network)
        tell(result)

    with Journal(folder) as journal:
        try:
            if plan.is_search:
                _search(plan, folder, engine, journal, take)
            else:
                _run_batch(plan, plan.choices(), 0, [], engine, journal, take)
        except KeyboardInterrupt:
            interrupted = True
    results.sort(key=lambda result: result.number)
    return Sweep(plan, folder, tuple(results), interrupted)


def _search(
    plan: SweepPlan,
    folder: Path,
    engine: Engine,
    journal: Journal,
    take: Callable[[TrialResult], object],
) -> None:
    need("sweep", "optuna")
    search = _OptunaSearch(plan, folder)
    done: list[TrialResult] = []
    while len(done) < plan.trials:
        choices = search.ask(min(plan.batch, plan.trials - len(done)))
        rivals = [each.curve for each in done if each.state == "finished"]
        batch = _run_batch(plan, choices, len(done), rivals, engine, journal, take)
        search.tell(batch)
        done += batch


class _OptunaSearch:
    """A sweep's trials as Optuna proposes them: ask for a batch, tell the results, ask again.

    Proposals depend on the plan and on the results told so far, and on nothing else: the same
    sweep proposes the same trials on every engine, and again when it goes on. So the study is
    written anew at each start, and the sweep's own journal is what is kept.

    Args:
        plan: the sweep's plan.
        folder: gets the study in Optuna's journal format, for tools such as optuna-dashboard.
    """

    def __init__(self, plan: SweepPlan, folder: Path) -> None:
        import optuna
        from optuna.storages.journal import JournalFileBackend

        optuna.logging.set_verbosity(optuna.logging.ERROR)
        self._plan = plan
        path = folder / STUDY
        path.unlink(missing_ok=True)
        self._study = optuna.create_study(
            study_name=str(plan.scene["name"]),
            direction="maximize",
            storage=optuna.storages.JournalStorage(JournalFileBackend(str(path))),
            sampler=optuna.samplers.TPESampler(seed=0, n_startup_trials=max(10, plan.batch)),
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
        from optuna.trial import TrialState

        for trial, result in zip(self._asked, results, strict=True):
            if result.error:
                self._study.tell(trial, state=TrialState.FAIL)
                continue
            for step, value in enumerate(result.curve[: len(result.checks)]):
                trial.report(value, step)
            trial.set_user_attr("seed", result.choice.seed)
            if result.pruned:
                self._study.tell(trial, state=TrialState.PRUNED)
            else:
                self._study.tell(trial, result.value)

    def _choice(self, trial: "optuna.Trial", seed: int) -> Choice:
        algorithm: Any = trial.suggest_categorical("algorithm", self._plan.algorithms)
        chosen = {
            each.name: _suggested(trial, each)
            for each in self._plan.parameters
            if each.is_for(algorithm)
        }
        return Choice(algorithm=algorithm, seed=seed, settings=chosen)


def _suggested(trial: "optuna.Trial", parameter: Parameter) -> Value:
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


def _run_batch(
    plan: SweepPlan,
    choices: Sequence[Choice],
    first: int,
    rivals: list[list[float]],
    engine: Engine,
    journal: Journal,
    take: Callable[[TrialResult], object],
) -> list[TrialResult]:
    """Run some trials, and return their results in order."""
    has_goal = plan.has_goal
    jobs = [plan.job(each, rivals) for each in choices]
    places: dict[str, list[int]] = {}
    for place, job in enumerate(jobs):
        places.setdefault(job.key, []).append(place)
    results: dict[int, TrialResult] = {}
    for outcome in run_jobs(jobs, engine, journal=journal):
        for place in places[outcome.job.key]:
            number = first + place
            results[place] = TrialResult.of(number, choices[place], outcome, has_goal)
            take(results[place])
    return [results[place] for place in range(len(jobs))]


def evaluated(sweep: Sweep, seeds: Sequence[int], tell: Callable[[], None]) -> Sweep:
    """Evaluate a sweep's best network, and return the sweep with the evaluation.

    Args:
        sweep: the sweep.
        seeds: of the episodes; trainings and their checks use none below 2**32.
        tell: called after each episode.
    """
    if sweep.best is None:
        return sweep
    path = sweep.folder / BEST
    write_atomically(path, sweep.best.network)
    told = evaluate(entrant(str(path)), scene_from(sweep.plan.scene), seeds, tell=tell)
    return Sweep(sweep.plan, sweep.folder, sweep.results, sweep.is_interrupted, told)


def write_report(sweep: Sweep) -> Path | None:
    """Write table, pictures and page; return the page's path, or None if no trial has ended."""
    if not sweep.results:
        return None
    folder, names = sweep.folder, [each.name for each in sweep.plan.parameters]
    write_atomically(folder / "trials.csv", csv_text(sweep.results, names))
    if sweep.best is not None:
        write_atomically(folder / BEST, sweep.best.network)
    pictures = draw_pictures(sweep.results, names, folder)
    page = folder / PAGE
    text = page_of(sweep.plan, sweep.results, sweep.evaluation, total_of(sweep.plan), pictures)
    write_atomically(page, text)
    return page
