"""Commands for training; heavy imports happen when a command runs."""

import json
from contextlib import ExitStack, closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import seeds_from
from ai4u_edu.cli import training_options as o
from ai4u_edu.cli.options import (
    OwnBlocks,
    expect_scene,
    is_driver,
    let_it_drive,
    load_own_blocks,
    say,
)
from ai4u_edu.cli.sweep import sweep
from ai4u_edu.cli.tournament import tournament
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, translate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ai4u_edu.learn.training.evaluating import Evaluation
    from ai4u_edu.learn.training.run import Trained
    from ai4u_edu.learn.training.watch import Watch


def add_to(app: typer.Typer) -> None:
    """Add the commands to a command line."""
    app.command()(train)
    app.command()(sweep)
    app.command()(evaluate)
    app.command()(vary)
    app.command()(tournament)
    app.command()(export)


def train(
    scene: o.TrainedScene = "",
    algo: o.Algorithm = "",
    steps: o.Steps = None,
    seed: o.TrainingSeed = 0,
    out: o.TrainingFolder = None,
    settings: o.SettingsFile = None,
    policy: o.PolicyKind = "",
    observe: o.Observed = None,
    resume: o.Resume = False,
    overwrite: o.Overwrite = False,
    keep_checkpoints: o.KeepCheckpoints = False,
    watch: o.WatchFlag = False,
    port: o.WatchPort = 8080,
    trainer: o.Trainer = "",
    begin_with: o.BeginWith = None,
    reward: o.RewardWeights = None,
    agent: o.LearningAgent = "",
    against: o.Against = "",
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Train an agent in a scene. Ctrl-C ends it early and keeps what was learned.

    With pip install "ai4u-edu\[train]", Stable-Baselines3 learns; without it, the small learner.
    """
    from ai4u_edu.learn.training import train as trained

    if resume and out is None:
        raise SetupError(_("--resume needs --out, the folder of the training to go on with"))
    load_own_blocks(own_blocks)
    with ExitStack() as ending:
        page = ending.enter_context(_page(port)) if watch else None
        result = trained(
            scene or "box_chase",
            algo,
            steps=steps,
            seed=seed,
            out=out,
            settings=settings,
            policy=policy,
            observe=observe or (),
            resume=resume,
            overwrite=overwrite,
            keep_checkpoints=keep_checkpoints,
            watch=page or False,
            trainer=trainer,
            begin_with=begin_with,
            reward_weights=dict(map(_weight, reward or ())),
            agent=agent,
            against=against,
        )
        say(_summary(result, "" if resume else scene or "box_chase"))
        if page and not result.interrupted:
            with suppress(KeyboardInterrupt):  # as soon as it is announced
                say(_("the trained policy drives in the page; Ctrl-C ends it"))
                page.wait()


def _weight(text: str) -> tuple[str, float]:
    """Return name and factor of ``NAME=FACTOR``.

    Raises:
        BadParameter: it is of another form.

    >>> _weight("touch=-0.5")
    ('touch', -0.5)
    """
    name, equals, factor = text.rpartition("=")
    try:
        return name, float(factor if name and equals else "")
    except ValueError:
        raise typer.BadParameter(
            _("expected a reward term and its factor, such as touch=2, got {text!r}", text=text)
        ) from None


def _page(port: int) -> "Watch":
    from ai4u_edu.base.optional_deps import need

    need("train", "torch", "stable_baselines3")
    from ai4u_edu.learn.training.watch import Watch

    return Watch(port)


def _summary(result: "Trained", scene: str) -> str:
    """Return how a training went, and the commands that follow.

    Args:
        result: of the training.
        scene: name or file, as it was given; empty for the one in the training's folder.
    """
    best, folder = result.best, result.run.folder
    is_small = result.run.config().trainer == "small"
    kept = result.run.best_network if is_small else result.run.best
    reward = _("reward {reward:.2f} (after {steps} steps)", reward=best.reward, steps=best.steps)
    if best.success is not None:
        success = _("success {success:.0%}", success=best.success)
        reward = _("{success}, {reward}", success=success, reward=reward)
    why = _("interrupted") if result.interrupted else _("done")
    if result.enough and not result.interrupted:
        why = _("good enough")
    return _(
        "{why} after {steps} steps; kept {kept}: {result}\n"
        "evaluate it: {evaluate}\n"
        "export it:   {export}",
        why=why,
        steps=result.steps,
        kept=str(kept),
        result=reward,
        evaluate=" ".join(filter(None, ("ai4u-edu evaluate", scene, f"--brain {folder}"))),
        export=f"ai4u-edu export {folder} --out policy.onnx",
    )


def evaluate(
    words: o.EvaluatedScene = None,
    brain: o.EvaluatedDrivers = None,
    scene: o.FormerScene = "",
    compare: o.FormerDrivers = None,
    episodes: o.Episodes = 100,
    seed: o.FirstSeed = 0,
    json_file: o.JsonFile = None,
    plot: o.Plot = None,
    engine: o.EngineName = "inline",
    address: o.ClusterAddress = "",
    own_blocks: OwnBlocks = None,
) -> None:
    """Measure how well drivers do in a scene, on seeds not used for training.

    Reading a Stable-Baselines3 model (.zip) can run any program: use only your own.
    """
    from ai4u_edu.base.optional_deps import need
    from ai4u_edu.learn.training.evaluating import evaluate as evaluated
    from ai4u_edu.learn.training.evaluating import evaluation_table
    from ai4u_edu.learn.training.policies import entrant
    from ai4u_edu.learn.training.progress_bar import counted
    from ai4u_edu.scenes import Scene

    if plot is not None:
        need("train", "matplotlib")
        from ai4u_edu.learn.training.plots import check_picture, plot_evaluations

        check_picture(plot)
    load_own_blocks(own_blocks)
    where, drivers = _scene_and_drivers(words or [], brain or [], scene, compare or [])
    loaded = Scene.load(where) if where else None
    name = loaded.description.name if loaded else ""
    entrants = [entrant(each, name) for each in drivers]
    if loaded is None:
        where = next((each.scene for each in entrants if each.scene), "")
        if not where:
            raise SetupError(
                _(
                    "in which scene is {driver} to drive? Expected: "
                    "ai4u-edu evaluate SCENE --brain {driver}",
                    driver=drivers[0],
                )
            )
        loaded = Scene.load(where)
    seeds = seeds_from(seed, episodes)
    if engine == "inline" and not address:
        done = [evaluated(each, loaded, counted(seeds, each.name)) for each in entrants]
    else:
        done = _evaluated_on(engine, address, drivers, where, seeds, own_blocks)
    if json_file is None or str(json_file) != "-":
        Console().print(
            translate(
                ngettext(
                    "{name}: {n} episode, seed {seed}",
                    "{name}: {n} episodes, seeds {seed}..{last}",
                    episodes,
                    name=loaded.description.name,
                    seed=seed,
                    last=seed + episodes - 1,
                )
            ),
            highlight=False,
        )
        Console().print(evaluation_table(done))
    if json_file is not None:
        text = json.dumps([each.plain() for each in done], indent=1)
        if str(json_file) == "-":
            typer.echo(text)
        else:
            write_atomically(json_file, text + "\n")
    if plot is not None:
        plot_evaluations(done, plot)


def _scene_and_drivers(
    words: list[str], brains: list[str], scene: str, compare: list[str]
) -> tuple[str, list[str]]:
    """Return the scene, which may be empty, and who drives in it.

    The former form, in which the driver came first and the scene was an option, still works, with a
    hint: the one for all commands is the scene first, and drivers as options.
    """
    from ai4u_edu.scenes import Scene

    drivers = [*brains, *compare]
    if brains and not scene:
        expect_scene("evaluate", words)
        return (words or [""])[0], drivers
    names = Scene.names()
    scenes = [
        word for word in words if not is_driver(word) and (word in names or word.endswith(".yaml"))
    ]
    drivers = [*(word for word in words if word not in scenes), *drivers]
    scenes += [scene] if scene else []
    where = (scenes or [""])[0]
    if not drivers:
        raise SetupError(
            _(
                "who is to drive? Expected: ai4u-edu evaluate {scene} --brain DRIVER",
                scene=where or "SCENE",
            )
        )
    if len(scenes) > 1:
        raise SetupError(_("expected one scene, got {scenes}", scenes=", ".join(scenes)))
    right = " ".join([*scenes, *(f"--brain {driver}" for driver in drivers)])
    command = f"ai4u-edu evaluate {right}"
    say(_("hint: as in play, the scene comes first: {command}", command=command), err=True)
    return where, drivers


def _evaluated_on(
    name: str,
    address: str,
    drivers: "Sequence[str]",
    scene: str,
    seeds: "Sequence[int]",
    own_blocks: "Sequence[Path] | None",
) -> "list[Evaluation]":
    from ai4u_edu.games.jobs import engine
    from ai4u_edu.learn.training.evaluate_jobs import evaluate_on
    from ai4u_edu.learn.training.progress_bar import ProgressBar
    from ai4u_edu.scenes.scene_data import scene_data

    data = scene_data(scene, own_blocks or ())
    bar = ProgressBar(len(seeds) * len(drivers), _("episodes"), keep=False)
    with engine(name, address=address) as running, closing(bar):
        return evaluate_on(running, [(who, data) for who in drivers], seeds, tell=bar.add)


def vary(
    scene: Annotated[str, typer.Argument(help="Scene name or YAML file.")],
    parameter: o.VariedParameter = "",
    values: o.VariedValues = "",
    brain: o.VaryingDriver = "scene",
    episodes: o.Episodes = 20,
    seed: o.FirstSeed = 0,
    csv_file: o.CsvFile = None,
    workers: o.Workers = 1,
    own_blocks: OwnBlocks = None,
) -> None:
    """Drive from the same starts with each value of one number: of a block, a thing or the world.

    Without --parameter, it lists the numbers of the scene.
    """
    from ai4u_edu.games.jobs import engine
    from ai4u_edu.learn.training import varying as v
    from ai4u_edu.learn.training.assigned import agent_and_driver
    from ai4u_edu.learn.training.progress_bar import ProgressBar
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
    loaded = Scene.load(scene)
    agent, who = agent_and_driver(brain, [each.id for each in loaded.build().agents])
    if not parameter:
        Console().print(v.parameter_table(v.number_parameters(loaded)), highlight=False)
        return
    present = v.parameter_named(loaded, parameter)
    if not values:
        raise SetupError(
            _(
                "expected the values of {name} to try, as in --values 1,2,4; it is {value} now",
                name=present.name,
                value=str(present.value),
            )
        )
    numbers, seeds = v.parse_values(values), seeds_from(seed, episodes)
    driven, who = v.with_driver(loaded, who, agent)
    varied = v.parameter_named(driven, parameter)
    bar = ProgressBar(len(numbers) * episodes, _("episodes"), keep=False)
    with closing(bar), engine("inline" if workers == 1 else "processes", width=workers) as running:
        rows = v.try_values(
            driven,
            varied,
            numbers,
            seeds,
            running,
            who=who,
            agent=agent,
            own_blocks=own_blocks or (),
            tell=bar.add,
        )
    if csv_file is None or str(csv_file) != "-":
        say(
            ngettext(
                "{name}: {n} episode with each value, the same start (seed {seed})",
                "{name}: {n} episodes with each value, the same starts (seeds {seed}..{last})",
                episodes,
                name=loaded.description.name,
                seed=seed,
                last=seed + episodes - 1,
            )
        )
        Console().print(v.Tried(varied, rows).table(), highlight=False)
    if csv_file is not None:
        text = v.Tried(varied, rows).csv()
        if str(csv_file) == "-":
            typer.echo(text, nl=False)
        else:
            write_atomically(csv_file, text)


def export(
    model: Annotated[Path, typer.Argument(help="Folder of a training, or a model (.zip) in it.")],
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("policy.onnx"),
    with_critic: o.WithCritic = False,
    checkpoints: o.Checkpoints = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Export a model as a network (.onnx) that drives without torch and can be shared."""
    from ai4u_edu.learn.training import export as exported
    from ai4u_edu.learn.training.notebook import export_checkpoints
    from ai4u_edu.learn.training.run import run_of

    load_own_blocks(own_blocks)
    if checkpoints is not None:
        files = export_checkpoints(model, checkpoints, with_critic=with_critic)
        scene = run_of(model).config().scene
        say(
            _(
                "{networks} in {folder}\ncompare them:  {command}",
                networks=ngettext("{n} network", "{n} networks", len(files)),
                folder=str(checkpoints),
                command=f"ai4u-edu play {scene} --offer {checkpoints}",
            )
        )
        return
    path = exported(model, out, with_critic=with_critic)
    name = run_of(model).config().scene
    typer.echo(f"{path}: {path.stat().st_size / 1000:.0f} kB")
    let_it_drive(name, path)
