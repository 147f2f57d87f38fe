"""Commands for training; heavy imports happen when a command runs."""

import json
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

Folder = Annotated[Path, typer.Option(help="The training's folder.", show_default=False)]


def add_to(app: typer.Typer) -> None:
    """Add the commands to a command line."""
    app.command()(train)
    app.command()(evaluate)
    app.command()(export)


def train(
    scene: Annotated[
        str, typer.Argument(help="A scene of the library, or a YAML file; not with --resume.")
    ] = "",
    algo: Annotated[str, typer.Option(help="sac, ppo or dqn; left out, as the settings say.")] = "",
    steps: Annotated[
        int | None,
        typer.Option(
            help="Decisions to learn from; left out, as the settings say.",
            min=1,
            max=MAX_TRAINING_STEPS,
        ),
    ] = None,
    seed: Annotated[int, training_seed_option("The same seed gives the same model.")] = 0,
    out: Annotated[
        Path | None, typer.Option(help="The training's folder; left out: runs/SCENE-ALGO-SEED.")
    ] = None,
    settings: Annotated[
        Path | None, typer.Option(help="A YAML file in place of the scene's own settings.")
    ] = None,
    policy: Annotated[
        str, typer.Option(help="MlpPolicy, CnnPolicy (one picture), or MultiInputPolicy.")
    ] = "",
    observe: Annotated[
        list[str] | None, typer.Option(help="A perception key that it gets; once for each.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the training in --out.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Begin anew, and lose the training in --out.")
    ] = False,
    watch: Annotated[
        bool, typer.Option("--watch", help="Show the policy driving in the browser as it learns.")
    ] = False,
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Train an agent in a scene; Ctrl-C keeps what it has learned.

    Needs: pip install "ai4u-edu\[train]"
    """
    from ai4u_edu.training import train as trained

    if resume and out is None:
        raise SetupError("--resume needs --out, the folder of the training to go on with")
    load_own_blocks(own_blocks)
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
        watch=watch,
    )
    typer.echo(_summary(result))


def _summary(result: "Trained") -> str:
    best, folder = result.best, result.run.folder
    success = "" if best.success is None else f"success {best.success:.0%}, "
    why = "interrupted" if result.interrupted else "good enough" if result.enough else "done"
    return (
        f"{why} after {result.steps} steps; kept {result.run.best}: {success}"
        f"reward {best.reward:.2f} (after {best.steps} steps)\n"
        f"look at it:  ai4u-edu evaluate {folder}\n"
        f"export it:   ai4u-edu export {folder} --out policy.onnx"
    )


def evaluate(
    who: Annotated[
        str,
        typer.Argument(
            help="A training's folder, a model (.zip), a network (.onnx, zoo:SCENE, or zoo for the "
            "scene's own), a controller, FILE.py:NAME, random, or scene (its own controller)."
        ),
    ],
    scene: Annotated[
        str, typer.Option(help="A scene of the library, or a YAML file; left out: its own.")
    ] = "",
    compare: Annotated[
        list[str] | None, typer.Option(help="Somebody else, on the same seeds; more than once.")
    ] = None,
    episodes: Annotated[int, typer.Option(min=1, max=MAX_EPISODES)] = 100,
    seed: Annotated[int, seed_option("Of the first episode; then one by one.")] = 0,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write all of it to a file; - for the terminal.")
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="Draw it into a PNG file.")] = None,
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
    model: Annotated[Path, typer.Argument(help="A training's folder, or a model (.zip) in it.")],
    out: Annotated[Path, typer.Option(help="The network's file.")] = Path("policy.onnx"),
    own_blocks: OwnBlocks = None,
) -> None:
    """Write a model as a network (.onnx) that drives without torch, and can be shared."""
    from ai4u_edu.training import export as exported
    from ai4u_edu.training.run import run_of

    load_own_blocks(own_blocks)
    path = exported(model, out)
    name = run_of(model).config().scene
    typer.echo(
        f"{path}: {path.stat().st_size / 1000:.0f} kB\n"
        f"let it drive:  ai4u-edu play {name} --brain {path}"
    )
