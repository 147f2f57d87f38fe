"""Command for the course; heavy imports happen when it runs."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Annotated

import typer

from ai4u_edu.cli.options import say
from ai4u_edu.locale import catalogue, ngettext
from ai4u_edu.locale import gettext as _

FIRST = "00_start_here.ipynb"
KERNEL_STOP_S = 0.5
"""Time that a kernel gets to end before it is killed. So SIGTERM ends the course within about
a second, also if a cell does not return."""


def add_to(app: typer.Typer) -> None:
    """Add the command to a command line."""
    app.command()(lessons)


def lessons(
    folder: Annotated[Path, typer.Argument(help="Folder for the notebooks.")] = Path(
        "ai4u-lessons"
    ),
    port: Annotated[int, typer.Option(help="JupyterLab's port.", min=1, max=65535)] = 8888,
    open_page: Annotated[bool, typer.Option("--open/--no-open", help="Open the browser.")] = True,
    start: Annotated[bool, typer.Option("--start/--copy-only", help="Start JupyterLab.")] = True,
    collect: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Instead, write class.html and class.csv from all progress.json in that folder.",
        ),
    ] = None,
) -> None:
    r"""Copy the course into a folder and start JupyterLab on its first lesson.

    Notebooks that are there already are kept. Needs: pip install "ai4u-edu\[lessons]"
    """
    if collect is not None:
        _collect(collect)
        return
    from ai4u_edu.base.optional_deps import need
    from ai4u_edu.lessons.handout import hand_out, lab_config

    if start:
        need("lessons", "jupyterlab", "ipykernel", "matplotlib")
    done = hand_out(folder, catalogue().language)
    new, kept = len(done.new), len(done.kept)
    say(
        ngettext(
            "{n} new notebook in {folder}", "{n} new notebooks in {folder}", new, folder=str(folder)
        )
    )
    if done.kept:
        say(
            ngettext(
                "{n} was there already and is kept", "{n} were there already and are kept", kept
            )
        )
    for name in done.beside:
        older = name.replace(".new", "")
        say(_("a newer {older} is beside yours: {name}", older=older, name=name))
    if start:
        _become(lab(folder, port, open_page=open_page), lab_config(folder))


def _collect(folder: Path) -> None:
    from ai4u_edu.lessons.collecting import collect

    collected = collect(folder)
    for problem in collected.problems:
        say(problem, err=True)
    say(ngettext("{n} student:", "{n} students:", len(collected.students)))
    for path in collected.write(folder):
        typer.echo(f"  {path}")


def lab(folder: Path, port: int, *, open_page: bool) -> list[str]:
    """Return the command that starts JupyterLab on the first lesson, without internet access."""
    return [
        sys.executable,
        "-m",
        "jupyterlab",
        str((folder / FIRST).absolute()),
        f"--port={port}",
        f"--ServerApp.root_dir={folder.absolute()}",
        f"--ServerApp.open_browser={open_page}",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
        "--LabApp.extension_manager=readonly",
        f"--KernelManager.shutdown_wait_time={KERNEL_STOP_S}",
        # it looks for language servers, which takes seconds, and for which JupyterLab waits to end
        "--ServerApp.jpserver_extensions={'jupyter_lsp': False}",
        *(["--allow-root"] if os.name == "posix" and os.geteuid() == 0 else []),  # in a container
    ]


def _become(command: list[str], config: Path) -> None:
    """Replace this process by JupyterLab, so that every signal reaches it."""
    paths = [str(config), os.environ.get("JUPYTER_CONFIG_PATH", "")]
    env = {**os.environ, "JUPYTER_CONFIG_PATH": os.pathsep.join(filter(None, paths))}
    if os.name == "posix":
        os.execve(command[0], command, env)  # noqa: S606 - our own words
    raise typer.Exit(subprocess.call(command, env=env))  # noqa: S603 - our own words
