"""The command line; each command is a few lines around what the package offers."""

import gc
import json
import sys
from collections.abc import Sized
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu.errors import AI4UError
from ai4u_edu.version import __version__

app = typer.Typer(
    name="ai4u-edu",
    help="A top-down sandbox to learn how agents sense, decide and act.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def main() -> None:
    """Runs the command line; an error of ours is told in a sentence, without a traceback."""
    try:
        app()
    except AI4UError as error:
        typer.secho(f"error: {error}", err=True, fg=typer.colors.RED)
        sys.exit(1)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """A top-down sandbox to learn how agents sense, decide and act."""


@app.command()
def play(
    scene: Annotated[str, typer.Argument(help="A scene of the library, or a YAML file.")] = (
        "box_chase"
    ),
    host: Annotated[str, typer.Option(help="The address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="The port; 0 for any free one.", min=0, max=65535)] = (
        8080
    ),
    open_page: Annotated[
        bool, typer.Option("--open/--no-open", help="Open the page in the browser.")
    ] = True,
    seed: Annotated[int | None, typer.Option(help="Seed of the first episode.", min=0)] = None,
    time_scale: Annotated[
        float | None, typer.Option(help="How fast the time runs; 1 is real time.", min=0.01)
    ] = None,
    allow_host: Annotated[
        list[str] | None,
        typer.Option(help="A name under which the page is asked for, behind a proxy."),
    ] = None,
) -> None:
    """Serve a scene in the browser; drive with W, A, S, D."""
    from ai4u_edu.runner import Runner
    from ai4u_edu.scenes import Scene
    from ai4u_edu.server import hosts_for, open_on_desktop, room_app, serve, shut_side_door
    from ai4u_edu.viewer import Viewer

    loaded = Scene.load(scene)
    title = loaded.description.title or loaded.description.name
    runner = Runner(loaded.build(), seed=seed, time_scale=time_scale)
    viewer = Viewer(runner, title=title)
    shut_side_door(viewer.server)
    hosts = (*hosts_for(host), *(allow_host or ()))
    room = room_app(runner, viser_port=viewer.port, title=title, allowed_hosts=hosts)

    def ready(url: str) -> None:
        typer.echo(f"{title} is served at {url}  (Ctrl-C ends it)")
        if open_page:
            open_on_desktop(url)

    # what is there now stays; looking through it again and again, the garbage collector would stop
    # the world for a tenth of a second at a time
    gc.collect()
    gc.freeze()
    runner.start()
    viewer.start()
    try:
        serve(room, host, port, on_ready=ready)
    finally:
        viewer.stop()
        runner.stop()


@app.command()
def scenes() -> None:
    """List the scenes of the library."""
    from ai4u_edu.scenes import Scene

    table = Table(box=None, pad_edge=False)
    for heading in ("scene", "goal", "controls"):
        table.add_column(heading, overflow="fold", no_wrap=heading == "scene")
    for name in Scene.names():
        described = Scene.load(name).description
        table.add_row(name, described.goal, described.controls)
    Console().print(table)


@app.command()
def check(file: Annotated[Path, typer.Argument(help="A scene file.")]) -> None:
    """Say what is wrong in a scene file."""
    from ai4u_edu.scenes import Scene

    described = Scene.load(file).description
    typer.echo(
        f"{file}: fine: {_count(described.bodies, 'body', 'bodies')}, "
        f"{_count(described.floors, 'floor', 'floors')}, "
        f"{_count(described.agents, 'agent', 'agents')}"
    )


def _count(things: Sized, one: str, many: str) -> str:
    return f"{len(things)} {one if len(things) == 1 else many}"


@app.command()
def blocks(
    name: Annotated[str, typer.Argument(help="A block, to have it explained.")] = "",
) -> None:
    """List the blocks that agents are built from, or explain one."""
    from ai4u_edu.blocks.lesson_page import built_in_blocks, lesson_page, summary

    if name:
        typer.echo(lesson_page(name))
        return
    for kind, members in built_in_blocks().items():
        typer.secho(kind, bold=True)
        for cls in members:
            typer.echo(f"  {cls.__name__:<28}{summary(cls)}")


@app.command()
def schema() -> None:
    """Print the JSON Schema of scene files, for an editor to complete them."""
    from ai4u_edu.scenes.schema import scene_schema

    typer.echo(json.dumps(scene_schema(), indent=2))
