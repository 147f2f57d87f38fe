"""The command line; each command is a few lines around what the package offers."""

import json
import signal
import sys
from collections.abc import Sized
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu import episode_commands
from ai4u_edu.errors import AI4UError, SetupError
from ai4u_edu.lessons import commands as course
from ai4u_edu.training import commands as learning
from ai4u_edu.version import __version__

if TYPE_CHECKING:
    from ai4u_edu.cycle import ControlRequestor

app = typer.Typer(
    name="ai4u-edu",
    help="A top-down sandbox to learn how agents sense, decide and act.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

OwnBlocks = Annotated[
    list[Path] | None,
    typer.Option(
        "--blocks",
        help="A Python file with blocks of your own, which is run; once for each file.",
        show_default=False,
    ),
]


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
    context: typer.Context,
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
    token: Annotated[
        str,
        typer.Option(
            help="What page and scripts have to know; where other machines can reach it, one is "
            "made up if you choose none.",
            show_default=False,
        ),
    ] = "",
    seeded_resets: Annotated[
        bool,
        typer.Option(
            "--seeded-resets", help="Let one of several agents' scripts reset the whole world."
        ),
    ] = False,
    own_blocks: OwnBlocks = None,
    brain: Annotated[
        list[str] | None,
        typer.Option(
            help="Let a script drive: ai4u://127.0.0.1:8080, or 0=ai4u://... for agent 0; or a "
            "network: policy.onnx, or zoo for the one that comes with the scene."
        ),
    ] = None,
    record: Annotated[
        Path | None, typer.Option(help="A folder in which every episode is kept as a file.")
    ] = None,
    keep: Annotated[
        int, typer.Option(help="So many episodes are kept, to go back to.", min=1, max=1000)
    ] = episode_commands.KEPT,
    ghost: Annotated[
        Path | None,
        typer.Option(help="A recorded episode (.episode) to play against; its seed is the first."),
    ] = None,
    offer: Annotated[
        list[Path] | None,
        typer.Option(
            help="Python files with drivers, recorded episodes, or folders of them, from which the "
            "page may choose who drives; a script is run when it is chosen."
        ),
    ] = None,
    kept_scenes: Annotated[
        Path | None,
        typer.Option(
            "--scenes",
            help="A folder in which pages can save scenes under a name; left out, they can only "
            "download them.",
        ),
    ] = None,
    restore: Annotated[
        bool,
        typer.Option(
            "--restore",
            help="Go on with the scene that was left unsaved last; of SCENE, or by number, if one "
            "is named.",
        ),
    ] = False,
    autosave: Annotated[
        bool, typer.Option("--autosave/--no-autosave", help="Keep what is changed in the page.")
    ] = True,
) -> None:
    """Serve a scene in the browser; drive with W, A, S, D."""
    from ai4u_edu.recording import Episode
    from ai4u_edu.runner import Runner
    from ai4u_edu.scenes import Scene
    from ai4u_edu.server import (
        Rules,
        announcement,
        hosts_for,
        open_on_desktop,
        room_app,
        serve,
        shut_side_door,
        token_for,
        with_token,
    )
    from ai4u_edu.viewer import Viewer
    from ai4u_edu.workshop import Workshop
    from ai4u_edu.workshop.autosave import Autosave, unsaved_folder, unsaved_scenes
    from ai4u_edu.workshop.shelf import Shelf
    from ai4u_edu.workshop.unsaved import chosen, listed

    rules = Rules(token=token_for(host, token), seeded_resets=seeded_resets)
    _load(own_blocks)
    left = unsaved_scenes(unsaved_folder()) if autosave or restore else []
    source = context.get_parameter_source("scene")
    is_named = source is not None and source.name != "DEFAULT"
    wanted = chosen(left, scene if is_named else "") if restore else None
    loaded = Scene.load(scene) if wanted is None else wanted.scene()
    title = loaded.description.title or loaded.description.name
    sim = loaded.build()
    for each in brain or ():
        _give_brain(sim, each, loaded.description.name)
    recorder = episode_commands.recorder_into(record, sim, loaded, keep)
    run = Episode.load(ghost) if ghost else None
    if run is not None and seed is None:
        seed = run.seed
    runner = Runner(sim, seed=seed, time_scale=time_scale, recorder=recorder)
    workshop = Workshop(runner, loaded, offers=[*(offer or ()), *([record] if record else ())])
    saver = Autosave(unsaved_folder(), loaded.description.name, _warn) if autosave else None
    workshop.autosave = saver
    if wanted is not None:
        workshop.restored(wanted)
    elif left:
        workshop.unsaved = left[0]
    workshop.shelf = Shelf(kept_scenes) if kept_scenes is not None else None
    viewer = Viewer(runner, title=title, workshop=workshop)
    if run is not None and ghost is not None:
        viewer.ghosts.race(run, ghost.name)
    shut_side_door(viewer.server)
    hosts = (*hosts_for(host), *(allow_host or ()))
    room = room_app(
        runner,
        viser_port=viewer.port,
        title=lambda: workshop.title,
        allowed_hosts=hosts,
        rules=rules,
    )

    def ready(url: str) -> None:
        typer.echo(announcement(title, host, url, rules.token))
        if workshop.unsaved is not None:
            when = workshop.unsaved.when
            typer.echo(f"an unsaved scene from {when} is there: ai4u-edu play --restore")
        if len(left) > 1:
            typer.echo(f"unsaved scenes: {listed(left)}: ai4u-edu play SCENE --restore")
        if open_page:
            open_on_desktop(with_token(url, rules.token))

    runner.start()
    viewer.start()
    try:
        serve(room, host, port, on_ready=ready)
    finally:
        viewer.stop()
        runner.stop()
        if saver is not None:
            saver.stop()


def _warn(problem: str) -> None:
    typer.secho(f"warning: {problem}", err=True, fg=typer.colors.YELLOW)


@app.command()
def bridge(
    url: Annotated[str, typer.Argument(help="The world's address: ws://teacher:8080")],
    agent: Annotated[str, typer.Option(help="The agent's id; left out, the only one.")] = "",
    port: Annotated[
        int, typer.Option(help="Where the AI4U script listens.", min=1, max=65535)
    ] = 8080,
    token: Annotated[str, typer.Option(help="The world's, if its address has none.")] = "",
    realtime: Annotated[
        bool, typer.Option("--realtime", help="Don't have the world wait for each action.")
    ] = False,
    script_id: Annotated[
        str, typer.Option(help="The id by which the script knows its agent.")
    ] = "0",
) -> None:
    """Let an AI4U script on this machine drive an agent of a world elsewhere."""
    from ai4u_edu.remote.bridge import Bridge

    mode: Literal["realtime", "lockstep"] = "realtime" if realtime else "lockstep"
    there = Bridge(
        url, agent, port=port, token=token, mode=mode, script_id=script_id, tell=typer.echo
    )

    def asked_to_end(*_: object) -> None:
        # at a place that suits it; in the middle of a message it might never be done with it
        there.stop()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # asked twice: at once

    signal.signal(signal.SIGINT, asked_to_end)
    with suppress(KeyboardInterrupt):
        there.run()


def _give_brain(sim: "ControlRequestor", address: str, scene: str) -> None:
    from ai4u_edu.blocks.brains.address import agent_and_address, brain_at

    agent_id, where = agent_and_address(address)
    if not agent_id and len(sim.agents) > 1:
        ids = ", ".join(agent.id for agent in sim.agents)
        raise SetupError(
            f"--brain {address}: the scene has several agents ({ids}); name one, as in "
            f"--brain {sim.agents[0].id}={address}"
        )
    agent = sim.agent(agent_id) if agent_id else sim.agents[0]
    if where == "zoo" or where.startswith("zoo:") or where.endswith(".onnx"):
        from ai4u_edu.blocks import trained_brain

        agent.use_brain(trained_brain(f"zoo:{scene}" if where == "zoo" else where))
        return
    before, brain = agent.brain, brain_at(where)
    agent.use_brain(brain.changed(skip_frame=before.skip_frame, repeat_action=before.repeat_action))


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
def check(
    file: Annotated[Path, typer.Argument(help="A scene file.")], own_blocks: OwnBlocks = None
) -> None:
    """Say what is wrong in a scene file."""
    from ai4u_edu.scenes import Scene

    _load(own_blocks)
    described = Scene.load(file).description
    typer.echo(
        f"{file}: fine: {_count(described.bodies, 'body', 'bodies')}, "
        f"{_count(described.floors, 'floor', 'floors')}, "
        f"{_count(described.agents, 'agent', 'agents')}"
    )


def _load(files: list[Path] | None) -> None:
    from ai4u_edu.blocks.own_file import load_blocks

    for file in files or ():
        load_blocks(file)


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


learning.add_to(app)
episode_commands.add_to(app)
course.add_to(app)
