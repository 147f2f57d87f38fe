"""Commands for training; heavy imports happen when a command runs."""

import json
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import seeds_from
from ai4u_edu.cli.options import (
    MAX_EPISODES,
    MAX_TRAINING_STEPS,
    OwnBlocks,
    load_own_blocks,
    seed_option,
    training_seed_option,
)

if TYPE_CHECKING:
    from ai4u_edu.training.learning import Trained
    from ai4u_edu.training.watch import Watch


def add_to(app: typer.Typer) -> None:
    """Add the commands to a command line."""
    app.command()(train)
    app.command()(evaluate)
    app.command()(export)


def train(
    scene: Annotated[
        str, typer.Argument(help="Scene name or YAML file. Default: box_chase. Not with --resume.")
    ] = "",
    algo: Annotated[str, typer.Option(help="sac, ppo or dqn. Default: as in the settings.")] = "",
    steps: Annotated[
        int | None,
        typer.Option(
            help="Number of decisions to learn from. Default: as in the settings.",
            min=1,
            max=MAX_TRAINING_STEPS,
        ),
    ] = None,
    seed: Annotated[
        int, training_seed_option("Random seed; the same seed gives the same model.")
    ] = 0,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the results. Default: runs/SCENE-ALGO-SEED.")
    ] = None,
    settings: Annotated[
        Path | None, typer.Option(help="YAML file to use instead of the scene's own settings.")
    ] = None,
    policy: Annotated[
        str,
        typer.Option(
            help="Kind of network: MlpPolicy, CnnPolicy (one picture) or MultiInputPolicy. "
            "Default: as in the settings."
        ),
    ] = "",
    observe: Annotated[
        list[str] | None,
        typer.Option(
            help="Perception key that the policy observes. Repeat the option for several. "
            "Default: as in the settings."
        ),
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue the training in --out.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Start again and delete the training in --out.")
    ] = False,
    watch: Annotated[
        bool,
        typer.Option(
            "--watch",
            help="Show the policy in the browser while it learns and afterwards; Ctrl-C ends it.",
        ),
    ] = False,
    port: Annotated[
        int,
        typer.Option(help="Port of the page with --watch; 0 for any free port.", min=0, max=65535),
    ] = 8080,
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Train an agent in a scene. Ctrl-C ends it early and keeps what was learned.

    Needs: pip install "ai4u-edu\[train]"
    """
    from ai4u_edu.training import train as trained

    if resume and out is None:
        raise SetupError("--resume needs --out, the folder of the training to go on with")
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
            watch=page or False,
        )
        typer.echo(_summary(result))
        if page and not result.interrupted:
            typer.echo("the trained policy drives in the page; Ctrl-C ends it")
            page.wait()


def _page(port: int) -> "Watch":
    from ai4u_edu.base.optional_deps import need

    need("train", "torch", "stable_baselines3")
    from ai4u_edu.training.watch import Watch

    return Watch(port)


def _summary(result: "Trained") -> str:
    best, folder = result.best, result.run.folder
    success = "" if best.success is None else f"success {best.success:.0%}, "
    why = "interrupted" if result.interrupted else "good enough" if result.enough else "done"
    return (
        f"{why} after {result.steps} steps; kept {result.run.best}: {success}"
        f"reward {best.reward:.2f} (after {best.steps} steps)\n"
        f"evaluate it: ai4u-edu evaluate {folder}\n"
        f"export it:   ai4u-edu export {folder} --out policy.onnx"
    )


def evaluate(
    who: Annotated[
        str,
        typer.Argument(
            help="The driver: a training's folder, a model (.zip), a network (.onnx, zoo:SCENE, or "
            "zoo for the scene's own), a controller, FILE.py:NAME (a function or a Controller), "
            "random, or scene (the scene's own controller)."
        ),
    ],
    scene: Annotated[
        str,
        typer.Option(help="Scene name or YAML file. Default: the one that the driver is made for."),
    ] = "",
    compare: Annotated[
        list[str] | None,
        typer.Option(help="Another driver, on the same seeds. Repeat the option for several."),
    ] = None,
    episodes: Annotated[
        int, typer.Option(help="Number of episodes.", min=1, max=MAX_EPISODES)
    ] = 100,
    seed: Annotated[int, seed_option("Seed of the first episode; the next ones count up.")] = 0,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write the results to a JSON file; - prints them.")
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="Draw the results into a PNG file.")] = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Measure how well a driver does, on seeds not used for training.

    Reading a Stable-Baselines3 model (.zip) can run any program: use only your own.
    """
    from ai4u_edu.base.optional_deps import need
    from ai4u_edu.scenes import Scene
    from ai4u_edu.training.evaluating import evaluate as evaluated
    from ai4u_edu.training.policies import entrant
    from ai4u_edu.training.progress_bar import counted
    from ai4u_edu.training.report import table

    if plot is not None:
        need("train", "matplotlib")
        from ai4u_edu.training.plots import check_picture, plot_evaluations

        check_picture(plot)
    load_own_blocks(own_blocks)
    loaded = Scene.load(scene) if scene else None
    name = loaded.description.name if loaded else ""
    entrants = [entrant(each, name) for each in (who, *(compare or ()))]
    if loaded is None:
        where = next((each.scene for each in entrants if each.scene), "")
        if not where:
            raise SetupError(f"in which scene is {who} to drive? Expected --scene")
        loaded = Scene.load(where)
    seeds = seeds_from(seed, episodes)
    done = [evaluated(each, loaded, counted(seeds, each.name)) for each in entrants]
    if json_file is None or str(json_file) != "-":
        Console().print(
            f"{loaded.description.name}: {episodes} episodes, seeds {seed}..{seed + episodes - 1}",
            highlight=False,
        )
        Console().print(table(done))
    if json_file is not None:
        text = json.dumps([each.plain() for each in done], indent=1)
        if str(json_file) == "-":
            typer.echo(text)
        else:
            write_atomically(json_file, text + "\n")
    if plot is not None:
        plot_evaluations(done, plot)


def export(
    model: Annotated[Path, typer.Argument(help="Folder of a training, or a model (.zip) in it.")],
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("policy.onnx"),
    own_blocks: OwnBlocks = None,
) -> None:
    """Export a model as a network (.onnx) that drives without torch and can be shared."""
    from ai4u_edu.training import export as exported
    from ai4u_edu.training.run import run_of

    load_own_blocks(own_blocks)
    path = exported(model, out)
    name = run_of(model).config().scene
    typer.echo(
        f"{path}: {path.stat().st_size / 1000:.0f} kB\n"
        f"let it drive:  ai4u-edu play {name} --brain {path}"
    )
