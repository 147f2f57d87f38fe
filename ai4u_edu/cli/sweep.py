"""The command ``sweep``; heavy imports happen when it runs."""

import re
import shlex
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.base.optional_deps import need
from ai4u_edu.base.seeding import MAX_TRAINING_SEED
from ai4u_edu.cli import training_options as o
from ai4u_edu.cli.options import MAX_TRAINING_STEPS, OwnBlocks, check_blocks, load_own_blocks, say
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

if TYPE_CHECKING:
    from ai4u_edu.learn.training.settings import Algorithm
    from ai4u_edu.learn.training.sweep.plan import SweepPlan
    from ai4u_edu.learn.training.sweep.result import TrialResult
    from ai4u_edu.learn.training.sweep.run import Sweep

MAX_SEEDS = 1000
EVALUATION_EPISODES = 100
SHOWN_TRIALS = 10
INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells have it."""

Vary = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        help="A setting to vary: NAME=LOW..HIGH, NAME=LOW..HIGH:log or NAME=VALUE,VALUE. "
        "Repeat the option for several; sac.NAME is for SAC alone.",
    ),
]
Trials = Annotated[
    int,
    typer.Option(
        help="Number of trials that Optuna proposes. Default: all combinations of the values.",
        min=0,
        max=100_000,
        show_default=False,
    ),
]
Batch = Annotated[
    int,
    typer.Option(
        help="Trials that Optuna proposes at once: more keep more cores busy, and know less "
        "of each other.",
        min=1,
        max=10_000,
    ),
]


LeaveOutRewards = Annotated[
    bool,
    typer.Option(
        "--leave-out-rewards",
        help="Train with all reward terms, and without each of them in turn; draws terms.png.",
    ),
]


def sweep(
    scene: Annotated[str, typer.Argument(help="Scene name or YAML file. Not with --resume.")] = "",
    algo: Annotated[
        str, typer.Option(help="Algorithms, as in sac,ppo. Default: as in the settings.")
    ] = "",
    seeds: Annotated[str, typer.Option(help="Seeds, as in 0-9 or 1,5,7.")] = "0",
    vary: Vary = None,
    trials: Trials = 0,
    batch: Batch = 8,
    steps: Annotated[
        int | None,
        typer.Option(
            help="Decisions of each trial. Default: as in the settings.",
            min=1,
            max=MAX_TRAINING_STEPS,
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the results. Default: runs/SCENE-sweep.")
    ] = None,
    settings: o.SettingsFile = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue the sweep in --out as it was begun.")
    ] = False,
    leave_out_rewards: LeaveOutRewards = False,
    engine: o.JobsEngine = "processes",
    address: o.ClusterAddress = "",
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Train with many settings and seeds, and keep the best network.

    Ctrl-C keeps what is finished; the same command, or --resume --out DIR, goes on.
    Needs: pip install "ai4u-edu\[train]", and "ai4u-edu\[sweep]" for --trials.
    """
    need("train", "torch", "stable_baselines3", "onnx", "matplotlib")
    load_own_blocks(own_blocks)
    if resume:
        plan, folder = _kept_plan(scene, out, trials)
        check_blocks(plan.scene, own_blocks)
        plan.check()
    else:
        plan = _plan(scene, algo, seeds, vary or (), trials, batch, steps, settings, own_blocks)
        plan = with_rewards_left_out(plan) if leave_out_rewards else plan
        plan.check()
        plan = plan.with_equal_budgets()
        name = Path(str(plan.scene["name"])).stem
        folder = out or Path("runs") / f"{name}-sweep"
        plan = _begun(plan, folder)
    if steps is not None and plan.steps is not None and plan.steps > steps:
        say(
            _(
                "{steps} steps and not {wanted}, for all trials alike: PPO learns from so "
                "many decisions at once",
                steps=plan.steps,
                wanted=steps,
            )
        )
    if unlike := plan.unlike_budgets():
        say(unlike)
    plan.save(folder)
    _report(_run(plan, folder, engine, address), engine)


def _plan(
    scene: str,
    algo: str,
    seeds: str,
    vary: "list[str] | tuple[()]",
    trials: int,
    batch: int,
    steps: int | None,
    settings: Path | None,
    own_blocks: list[Path] | None,
) -> "SweepPlan":
    from ai4u_edu.learn.training.settings import settings_for
    from ai4u_edu.learn.training.sweep.plan import SweepPlan
    from ai4u_edu.learn.training.sweep.search_space import Parameter
    from ai4u_edu.scenes.scene_data import scene_data, scene_from

    if trials:
        need("sweep", "optuna")
    if not scene:
        raise SetupError(_("expected the scene to train in, as in: ai4u-edu sweep box_chase"))
    data = scene_data(scene, own_blocks or ())
    how = settings_for(scene_from(data).description.name, settings)
    parameters = tuple(Parameter.parse(each) for each in vary)
    names = [each.name for each in parameters]
    for name in names:
        if names.count(name) > 1:
            raise SetupError(_("--set: expected each setting once, got {name!r} twice", name=name))
    return SweepPlan(
        scene=data,
        algorithms=_algorithms(algo or how.algorithm),
        seeds=parse_seeds(seeds),
        parameters=parameters,
        trials=trials,
        batch=batch if trials else 1,
        steps=steps,
        settings=how.model_dump(mode="json"),
    )


def with_rewards_left_out(plan: "SweepPlan") -> "SweepPlan":
    """Return a plan that also trains without each of the learner's reward terms.

    Raises:
        SetupError: there is no term that could be left out, or ``--set`` chooses them already.
    """
    from ai4u_edu.learn.training.settings import NO_REWARD
    from ai4u_edu.learn.training.sweep.search_space import LEFT_OUT, Parameter
    from ai4u_edu.scenes.scene_data import scene_from

    if any(each.name == LEFT_OUT for each in plan.parameters):
        raise SetupError(
            _("expected --set {left_out} or --leave-out-rewards, got both", left_out=LEFT_OUT)
        )
    sim = scene_from(plan.scene).build()
    agent = sim.agent(plan.settings["agent"]) if plan.settings["agent"] else sim.agents[0]
    names = [reward.name for reward in agent.rewards if reward.is_active]
    if len(names) < 2:
        raise SetupError(
            _("--leave-out-rewards: expected several reward terms, got {names}", names=str(names))
        )
    varied = Parameter(name=LEFT_OUT, values=(NO_REWARD, *names))
    return plan.model_copy(update={"parameters": (*plan.parameters, varied)})


def _algorithms(text: str) -> "tuple[Algorithm, ...]":
    from ai4u_edu.learn.training.settings import ALGORITHMS

    found = []
    for each in dict.fromkeys(text.lower().split(",")):
        known = next((name for name in ALGORITHMS if name == each.strip()), None)
        if known is None:
            raise SetupError(
                _(
                    "--algo: expected some of {algorithms}, got {each!r}; {hint}",
                    algorithms=", ".join(ALGORITHMS),
                    each=each,
                    hint=suggest(each, ALGORITHMS),
                )
            )
        found.append(known)
    return tuple(found)


def parse_seeds(text: str) -> tuple[int, ...]:
    """Return the seeds that a text names.

    Raises:
        SetupError: it names none, or too many.

    >>> parse_seeds("0-3,7")
    (0, 1, 2, 3, 7)
    """
    found: dict[int, None] = {}
    for part in text.split(","):
        match = re.fullmatch(r"\s*(\d{1,10})(?:-(\d{1,10}))?\s*", part)
        first, last = (int(match[1]), int(match[2] or match[1])) if match else (1, 0)
        if not first <= last <= MAX_TRAINING_SEED or last - first >= MAX_SEEDS:
            raise SetupError(
                _(
                    "--seeds: expected numbers up to {most}, as in 0-9 or 1,5,7 (at most "
                    "{most2} of them), got {text!r}",
                    most=MAX_TRAINING_SEED,
                    most2=MAX_SEEDS,
                    text=text,
                )
            )
        found.update(dict.fromkeys(range(first, last + 1)))
    return tuple(found)


def _kept_plan(scene: str, out: Path | None, trials: int) -> "tuple[SweepPlan, Path]":
    from ai4u_edu.learn.training.sweep.plan import SweepPlan

    if out is None or scene:
        raise SetupError(
            _("--resume goes on as it was begun: expected --out, the sweep's folder, and no scene")
        )
    plan = SweepPlan.load(out)
    if trials and not plan.is_search:
        raise SetupError(_("{out} tries all combinations; expected no --trials", out=str(out)))
    return (plan.model_copy(update={"trials": trials}) if trials else plan), out


def _begun(plan: "SweepPlan", folder: Path) -> "SweepPlan":
    """Return the plan, unless the folder holds a sweep of another one."""
    from ai4u_edu.learn.training.sweep.plan import FILE, SweepPlan

    if (folder / FILE).exists():
        different = plan.difference(SweepPlan.load(folder))
        if different:
            raise SetupError(
                _(
                    "{folder} holds a sweep with other {different}; go on with that one "
                    "(--resume --out {folder}), or choose another folder (--out)",
                    folder=str(folder),
                    different=different,
                )
            )
    return plan


def _run(plan: "SweepPlan", folder: Path, engine_name: str, address: str) -> "Sweep":
    from ai4u_edu.base.seeding import seeds_from
    from ai4u_edu.games.jobs import engine
    from ai4u_edu.games.jobs.journal import count_done
    from ai4u_edu.learn.training.progress_bar import ProgressBar
    from ai4u_edu.learn.training.sweep.result import ranked
    from ai4u_edu.learn.training.sweep.run import evaluated, run_sweep, total_of, write_report

    results: list[TrialResult] = []
    kept = min(count_done(folder), total_of(plan))
    bar = ProgressBar(total_of(plan), _("trials"), done=kept)

    def tell(result: "TrialResult") -> None:
        results.append(result)
        if result.error:
            bar.note(
                translate(
                    _(
                        "trial {number} ({label}) failed: {problem}",
                        number=result.number,
                        label=result.label,
                        problem=result.error,
                    )
                )
            )
        best = ranked(results)[0]
        shown = ""
        if best.checks:
            success = best.best.success
            value = f"{best.value:.2f}" if success is None else f"{success:.0%}"
            shown = translate(_("best {value}", value=value))
        bar.show(max(kept, len(results)), shown)

    with closing(bar), engine(engine_name, address=address) as running:
        done = run_sweep(plan, folder, running, tell=tell)
    if not done.is_interrupted:
        seeds = seeds_from(0, EVALUATION_EPISODES)
        bar = ProgressBar(len(seeds), _("episodes, best"), keep=False)
        with closing(bar):
            done = evaluated(done, seeds, lambda: bar.add(1))
    write_report(done)
    return done


def _report(done: "Sweep", engine: str) -> None:
    from ai4u_edu.learn.training.sweep.result import ranked
    from ai4u_edu.learn.training.sweep.run import BEST, PAGE, total_of

    folder = done.folder
    again = f"ai4u-edu sweep --resume --out {shlex.quote(str(folder))}"
    again += "".join(f" --blocks {shlex.quote(each)}" for each in done.plan.scene.get("blocks", ()))
    if engine != "processes":
        again += f" --engine {engine}"
    if done.results:
        names = [each.name for each in done.plan.parameters]
        rows = [each.cells(names) for each in ranked(done.results)[:SHOWN_TRIALS]]
        shown = Table(box=None, pad_edge=False)
        for heading in rows[0]:
            shown.add_column(
                translate(heading),
                justify="left" if heading == "algorithm" else "right",
                overflow="fold",  # words of some languages are wider than the terminal
            )
        for row in rows:
            shown.add_row(*map(translate, row.values()))
        Console().print(shown)
    if done.evaluation is not None:
        say(_("best network, {evaluation}", evaluation=repr(done.evaluation)))
        say(
            _(
                "let it drive: ai4u-edu play {name} --brain {folder}",
                name=done.plan.scene["name"],
                folder=str(folder / BEST),
            )
        )
    if done.results:
        say(_("report: {path}", path=str(folder / PAGE)))
    if done.is_interrupted:
        count = len(done.results)
        say(
            _(
                "interrupted after {count} of {total} trials; go on with: {again}",
                count=count,
                total=total_of(done.plan),
                again=again,
            )
        )
        raise typer.Exit(INTERRUPTED)
    if not any(each.checks for each in done.results):
        raise SetupError(_("no trial has finished: {problem}", problem=done.results[0].error))
