"""The command line's entry point and its short commands."""

import gettext as gnu
import io
import json
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.numeric_threads import restart_with_one_thread
from ai4u_edu.base.version import __version__
from ai4u_edu.cli import episodes, lessons, training
from ai4u_edu.cli.bundle import bundle
from ai4u_edu.cli.classroom import classroom
from ai4u_edu.cli.doctor import doctor
from ai4u_edu.cli.options import (
    SCENE_AND_MORE,
    OnMissing,
    OwnBlocks,
    finite,
    load_own_blocks,
    say,
)
from ai4u_edu.cli.play import play
from ai4u_edu.cli.refusals import App, refuse
from ai4u_edu.locale import (
    LANGUAGES,
    PYTHON,
    VARIABLE,
    catalogue,
    known_language,
    library_text,
    ngettext,
    translate,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale.catalogues import FOLDER

LANGUAGE_OPTION = "--lang"
ONE_THREAD_COMMANDS = ("clone", "train")
"""Commands whose networks depend on the count of threads in which NumPy computes."""
app = App(
    name="ai4u-edu",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def main() -> None:
    """Run the command line.

    An error of ours, or a file that can't be read or written, is printed as one sentence without a
    traceback. What the console's encoding lacks is printed as a question mark.
    """
    if sys.argv[1:2] and sys.argv[1] in ONE_THREAD_COMMANDS:
        restart_with_one_thread()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    _take_language(sys.argv)
    try:
        status = _translated_command()(standalone_mode=False)
        sys.exit(status if isinstance(status, int) else 0)
    except AI4UError as error:
        _fail(translate(text_of(error)))
    except OSError as error:
        if error.filename is None:  # no file's
            raise
        _fail(f"{error.filename}: {error.strerror}")
    except typer.Abort:
        _fail(_("interrupted"))
    except typer.TyperException as error:
        refuse(error)
    except SystemExit as ended:
        exits = sys.modules.get("ai4u_edu.page.server.process_exit")  # of a command that has served
        if exits is not None:
            exits.end_process(ended.code if isinstance(ended.code, int) else 0)
        raise


def _fail(text: str) -> None:
    words = translate(_("error: {text}", text=text))
    typer.secho(words, err=True, fg=typer.colors.RED)
    sys.exit(1)


def _take_language(words: list[str]) -> None:
    """Take ``--lang CODE`` from the words of a command line, wherever it stands, and obey it."""
    for number, word in enumerate(words):
        name, has_value, value = word.partition("=")
        if name != LANGUAGE_OPTION:
            continue
        wanted = value if has_value else "".join(words[number + 1 : number + 2])
        code = known_language(wanted)
        if not code:
            known = ", ".join(LANGUAGES)
            _fail(_("--lang: expected one of {known}, got {wanted!r}", known=known, wanted=wanted))
        del words[number : number + (1 if has_value else 2)]
        os.environ[VARIABLE] = code  # rooms, notebooks and other processes inherit it
        break
    # click has its own words translated by gettext's global domain
    os.environ["LANGUAGE"] = catalogue().language
    gnu.bindtextdomain(PYTHON, FOLDER)
    gnu.textdomain(PYTHON)


def _translated_command() -> Callable[..., object]:
    command = typer.main.get_command(app)
    for part in _helped(command):
        part.help = catalogue().message(part.help)
    return command


def help_texts() -> list[str]:
    """Return the texts of this command line's help."""
    return [part.help for part in _helped(typer.main.get_command(app))]


def _helped(command: Any) -> Iterator[Any]:
    """Yield each command, option and argument that has a help, below a command of Typer's."""
    # Typer brings a click of its own, whose classes have no public name
    for part in (command, *command.params):
        if getattr(part, "help", None):
            yield part
    for _name, below in sorted(getattr(command, "commands", {}).items()):
        yield from _helped(below)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(__version__)
        raise typer.Exit


@app.callback(help="A top-down sandbox to learn how agents sense, decide and act.")
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
    lang: Annotated[
        str,
        typer.Option(
            metavar="CODE",
            help="Language, such as pt_BR. Default: that of your browser or terminal.",
        ),
    ] = "",
) -> None:
    """Handle the options of the program itself; :func:`main` has taken ``--lang`` before."""


app.command(context_settings=SCENE_AND_MORE)(play)
app.command("class")(classroom)
app.command()(doctor)
app.command()(bundle)


@app.command()
def bridge(
    url: Annotated[str, typer.Argument(help="Address of the world, such as ws://teacher:8080.")],
    agent: Annotated[str, typer.Option(help="The agent's id. Default: the only agent.")] = "",
    port: Annotated[
        int, typer.Option(help="Port at which the AI4U script listens.", min=1, max=65535)
    ] = 8080,
    token: Annotated[str, typer.Option(help="The world's token, unless its address has it.")] = "",
    realtime: Annotated[
        bool, typer.Option("--realtime", help="Don't make the world wait for each action.")
    ] = False,
    script_id: Annotated[str, typer.Option(help="The agent's id in the AI4U script.")] = "0",
    patience: Annotated[
        float,
        typer.Option(
            help="Seconds to wait: for a script that is silent, for a world that is not there, and "
            "for an agent that another script has.",
            min=0.1,
            max=3600,
            callback=finite,
        ),
    ] = 10.0,
    on_missing: Annotated[
        OnMissing | None,
        typer.Option(
            help="What the agent does when the script's action is missing: repeat the last action "
            "(hold), no action (coast), or zeros for all actuators (stop). Default: as the world "
            "is set.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Let an AI4U script on this machine drive an agent in a world on another one."""
    from ai4u_edu.remote.bridge import Bridge

    mode: Literal["realtime", "lockstep"] = "realtime" if realtime else "lockstep"
    there = Bridge(
        url,
        agent,
        port=port,
        token=token,
        mode=mode,
        script_id=script_id,
        patience=patience,
        on_missing=on_missing or "",
        tell=lambda text: typer.echo(translate(text)),
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
    name: Annotated[str, typer.Argument(help="Only this scene, or a scene file.")] = "",
    pictures: Annotated[
        Path | None,
        typer.Option(
            help="Folder for a picture (PNG) of each scene from above, instead of the list.",
            show_default=False,
        ),
    ] = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """List the scenes of the library with goal, controls and rewards, or draw them."""
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
    names = [name] if name else Scene.names()
    if pictures is not None:
        from ai4u_edu.page.editing.scene_pictures import write_picture

        for each in names:
            path = write_picture(Scene.load(each), pictures)
            typer.echo(f"{path}: {path.stat().st_size / 1000:.1f} kB")
        return
    console = Console(highlight=False)
    for each in names:
        described = Scene.load(each).description
        title = f" ({translate(library_text(described.title))})" if described.title else ""
        console.print(Text.assemble((each, "bold"), title))
        table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 0, 0, 2))
        table.add_column(no_wrap=True)
        table.add_column(overflow="fold")
        texts = {
            _("goal"): described.goal,
            _("controls"): described.controls,
            _("rewards"): described.rewards,
        }
        for heading, text in texts.items():
            # a text of a scene may hold brackets, which are no markup here
            table.add_row(translate(heading), Text(translate(library_text(text))))
        console.print(table)
        console.print()


@app.command()
def check(
    file: Annotated[Path, typer.Argument(help="A scene file.")], own_blocks: OwnBlocks = None
) -> None:
    """Check a scene file: drive its agents at random, and report what is wrong, like check_scene.

    It exits with status 1 if a check failed; warnings may be intended.
    """
    from ai4u_edu.check import check_scene
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
    scene = Scene.load(file)
    described = scene.description
    typer.echo(
        translate(
            _(
                "{file}: {bodies}, {floors}, {agents}",
                file=str(file),
                bodies=ngettext("{n} body", "{n} bodies", len(described.bodies)),
                floors=ngettext("{n} floor", "{n} floors", len(described.floors)),
                agents=ngettext("{n} agent", "{n} agents", len(described.agents)),
            )
        )
    )
    report = check_scene(scene)
    typer.echo(str(report))
    if not report.ok:
        raise typer.Exit(1)


@app.command()
def blocks(
    name: Annotated[str, typer.Argument(help="Explain this block.")] = "",
) -> None:
    """List the blocks that agents are built from, or explain one."""
    from ai4u_edu.blocks.docs import KIND_TITLES, built_in_blocks, lesson_page, short_summary

    if name:
        say(lesson_page(name))
        return
    for kind, members in built_in_blocks().items():
        typer.secho(translate(KIND_TITLES[kind]), bold=True)
        for cls in members:
            typer.echo(f"  {cls.__name__:<28}{translate(short_summary(cls))}")


@app.command()
def schema() -> None:
    """Print the JSON Schema of scene files, for completion in an editor."""
    from ai4u_edu.scenes.schema import scene_schema

    typer.echo(json.dumps(scene_schema(), indent=2))


training.add_to(app)
episodes.add_to(app)
lessons.add_to(app)
