"""The command line; each command is a few lines around what the package offers."""

import json
import signal
import sys
from collections.abc import Sized
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.base.version import __version__
from ai4u_edu.cli import episodes
from ai4u_edu.cli import lessons as course
from ai4u_edu.cli import training as learning
from ai4u_edu.cli.options import (
    MAX_TIME_SCALE,
    MIN_TIME_SCALE,
    OwnBlocks,
    finite,
    load_own_blocks,
    seed_option,
)

if TYPE_CHECKING:
    from ai4u_edu.agent.cycle import ControlRequestor
    from ai4u_edu.scenes import Scene

app = typer.Typer(
    name="ai4u-edu",
    help="A top-down sandbox to learn how agents sense, decide and act.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

OnMissing = Literal["hold", "coast", "stop"]


def main() -> None:
    """Runs the command line; an error of ours is told in a sentence, without a traceback.

    So is a file that can't be read or written, wherever a command line names one.
    """
    try:
        app()
    except AI4UError as error:
        _fail(str(error))
    except OSError as error:
        if error.filename is None:  # no file's
            raise
        _fail(f"{error.filename}: {error.strerror}")
    except SystemExit as ended:
        exits = sys.modules.get("ai4u_edu.server.process_exit")  # of a command that has served
        if exits is not None:
            exits.end_process(ended.code if isinstance(ended.code, int) else 0)
        raise


def _fail(text: str) -> None:
    typer.secho(f"error: {text}", err=True, fg=typer.colors.RED)
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
    seed: Annotated[int | None, seed_option("Seed of the first episode.")] = None,
    time_scale: Annotated[
        float | None,
        typer.Option(
            help="How fast the time runs; 1 is real time.",
            min=MIN_TIME_SCALE,
            max=MAX_TIME_SCALE,
            callback=finite,
        ),
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
    connections: Annotated[
        int,
        typer.Option(
            help="Connections from one address, at most; each page has two. This machine's own "
            "are not counted.",
            min=1,
            max=100_000,
        ),
    ] = 120,
    seeded_resets: Annotated[
        bool,
        typer.Option(
            "--seeded-resets", help="Let one of several agents' scripts reset the whole world."
        ),
    ] = False,
    lockstep: Annotated[
        bool | None,
        typer.Option(
            "--lockstep/--no-lockstep",
            help="Let scripts have the world wait for their actions; left out, only where there is "
            "one agent.",
            show_default=False,
        ),
    ] = None,
    on_missing: Annotated[
        OnMissing | None,
        typer.Option(
            help="What an agent does when its script's action is missing, unless the script "
            "chooses: the last one again (hold), nothing (coast), or zeros for all actuators "
            "(stop). Left out: hold, and stop while its connection is lost.",
            show_default=False,
        ),
    ] = None,
    grace: Annotated[
        float,
        typer.Option(
            help="Seconds that an agent is kept for a script whose connection is lost.",
            min=0,
            max=600,
        ),
    ] = 3.0,
    receive_timeout: Annotated[
        int,
        typer.Option(
            help="Milliseconds for which the world waits for a script in lockstep; then it goes "
            "on until the script answers.",
            min=200,
            max=600_000,
        ),
    ] = 2000,
    own_blocks: OwnBlocks = None,
    brain: Annotated[
        list[str] | None,
        typer.Option(
            help="Who drives: an AI4U script (ai4u://127.0.0.1:8080), a network (policy.onnx, or "
            "zoo for the one that comes with the scene), FILE.py:NAME (a function or a "
            "Controller), a training's folder or a model (.zip) in it, a controller, random; "
            "ID=... for the agent of that id."
        ),
    ] = None,
    record: Annotated[
        Path | None, typer.Option(help="A folder in which every episode is kept as a file.")
    ] = None,
    keep: Annotated[
        int, typer.Option(help="So many episodes are kept, to go back to.", min=1, max=1000)
    ] = DEFAULT_KEPT_EPISODES,
    ghost: Annotated[
        Path | None,
        typer.Option(help="A recorded episode (.episode) to play against; its seed is the first."),
    ] = None,
    offer: Annotated[
        list[str] | None,
        typer.Option(
            help="Python files with drivers, networks (.onnx), recorded episodes (.episode), "
            "folders of them, or an AI4U script's address (ai4u://HOST:PORT), from which the page "
            "may choose who drives; a script is run when it is chosen."
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
    from ai4u_edu.editing import SceneEditor
    from ai4u_edu.editing.autosave import Autosave, unsaved_folder, unsaved_scenes
    from ai4u_edu.editing.scene_store import SceneStore
    from ai4u_edu.editing.unsaved import choose_unsaved, format_unsaved
    from ai4u_edu.recording import Episode, recorder_into
    from ai4u_edu.runtime.runner import Runner
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
    from ai4u_edu.server.process_exit import HAS_SERVED
    from ai4u_edu.viewer import Viewer

    rules = Rules(
        token=token_for(host, token),
        seeded_resets=seeded_resets,
        lockstep=lockstep,
        on_missing=on_missing or "",
        grace=grace,
        receive_timeout=receive_timeout,
    )
    load_own_blocks(own_blocks)
    left = unsaved_scenes(unsaved_folder()) if autosave or restore else []
    source = context.get_parameter_source("scene")
    is_named = source is not None and source.name != "DEFAULT"
    wanted = choose_unsaved(left, scene if is_named else "") if restore else None
    loaded = Scene.load(scene) if wanted is None else wanted.scene()
    title = loaded.description.title or loaded.description.name
    sim, loaded = _built(loaded, brain or [])
    recorder = recorder_into(record, sim, loaded, keep)
    run = Episode.load(ghost) if ghost else None
    if run is not None and seed is None:
        seed = run.seed
    runner = Runner(sim, seed=seed, time_scale=time_scale, recorder=recorder)
    editor = SceneEditor(runner, loaded, offers=[*(offer or ()), *([record] if record else ())])
    saver = Autosave(unsaved_folder(), loaded.description.name, _warn) if autosave else None
    editor.autosave = saver
    if wanted is not None:
        editor.mark_restored(wanted)
    elif left:
        editor.unsaved = left[0]
    editor.scene_store = SceneStore(kept_scenes) if kept_scenes is not None else None
    viewer = Viewer(runner, title=title, editor=editor)
    if run is not None and ghost is not None:
        viewer.ghosts.race(run, ghost.name)
    shut_side_door(viewer.server)
    room = room_app(
        runner,
        viser_port=viewer.port,
        title=lambda: editor.title,
        allowed_hosts=hosts_for(host),
        proxy_hosts=allow_host or (),
        rules=rules,
    )

    def ready(url: str) -> None:
        typer.echo(announcement(title, host, url, rules.token))
        if editor.unsaved is not None:
            when = editor.unsaved.when
            typer.echo(f"an unsaved scene from {when} is there: ai4u-edu play --restore")
        if len(left) > 1:
            typer.echo(f"unsaved scenes: {format_unsaved(left)}: ai4u-edu play SCENE --restore")
        if open_page:
            open_on_desktop(with_token(url, rules.token))

    runner.start()
    viewer.start()
    with ExitStack() as ending:  # the last one first: the runner may yet change what is saved
        ending.callback(viewer.stop)
        if saver is not None:
            ending.callback(saver.stop)
        ending.callback(runner.stop)
        serve(room, host, port, on_ready=ready, per_address=connections)
    HAS_SERVED.set()


def _built(scene: "Scene", drivers: list[str]) -> "tuple[ControlRequestor, Scene]":
    if not drivers:
        return scene.build(), scene
    from ai4u_edu.training.assigned import with_drivers  # costs what most don't need

    return with_drivers(scene, drivers, is_served=True)


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
    on_missing: Annotated[
        OnMissing | None,
        typer.Option(
            help="What the agent does when the script's action is missing; left out, as the world "
            "has it.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Let an AI4U script on this machine drive an agent of a world elsewhere."""
    from ai4u_edu.remote.bridge import Bridge

    mode: Literal["realtime", "lockstep"] = "realtime" if realtime else "lockstep"
    there = Bridge(
        url,
        agent,
        port=port,
        token=token,
        mode=mode,
        script_id=script_id,
        on_missing=on_missing or "",
        tell=typer.echo,
    )

    def asked_to_end(*_: object) -> None:
        # at a place that suits it; in the middle of a message it might never be done with it
        there.stop()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # asked twice: at once

    signal.signal(signal.SIGINT, asked_to_end)
    with suppress(KeyboardInterrupt):
        there.run()


@app.command()
def scenes(
    name: Annotated[str, typer.Argument(help="A scene, to see only that one.")] = "",
    own_blocks: OwnBlocks = None,
) -> None:
    """List the scenes of the library: what to reach, what drives, and what is paid."""
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
    console = Console(highlight=False)
    for each in [name] if name else Scene.names():
        described = Scene.load(each).description
        title = f" ({described.title})" if described.title else ""
        console.print(Text.assemble((each, "bold"), title))
        table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 0, 0, 2))
        table.add_column(no_wrap=True)
        table.add_column(overflow="fold")
        for heading in ("goal", "controls", "rewards"):
            # a text of a scene may hold brackets, which are no markup here
            table.add_row(heading, Text(getattr(described, heading)))
        console.print(table)
        console.print()


@app.command()
def check(
    file: Annotated[Path, typer.Argument(help="A scene file.")], own_blocks: OwnBlocks = None
) -> None:
    """Say what is wrong in a scene file."""
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
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
    from ai4u_edu.blocks.docs import built_in_blocks, lesson_page, summary

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
episodes.add_to(app)
course.add_to(app)
