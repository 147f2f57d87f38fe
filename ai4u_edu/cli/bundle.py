"""The command ``ai4u-edu bundle``: wheels, course and scenes for machines without internet."""

import importlib.util
import json
import re
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.version import __version__
from ai4u_edu.cli.options import say
from ai4u_edu.locale import catalogue
from ai4u_edu.locale import gettext as _

FILES = "ai4u_edu.cli.bundle_files"
SCRIPTS = {"start.py": "\n", "start.sh": "\n", "start.command": "\n", "start.bat": "\r\n"}
"""Line ends of each file; Windows reads no others in a .bat."""
EXTRAS = (*("lessons", "data", "hub", "multi", "ray", "sweep", "tournament", "train", "video"),)


def bundle(
    folder: Annotated[
        Path, typer.Argument(help="Folder for the bundle; an older one is added to.")
    ],
    extra: Annotated[
        list[str] | None,
        typer.Option(help=f"Also what these need: {', '.join(EXTRAS)}. May be repeated."),
    ] = None,
    wheel: Annotated[
        Path | None,
        typer.Option(help="Wheel of AI4U Edu. Default: built in a clone, else fetched."),
    ] = None,
) -> None:
    """Collect wheels, course and scenes in a folder, for machines without internet.

    The packages are those for this system and this Python. Run it on another system with the same
    folder, and it holds the packages of both.
    """
    extras = list(dict.fromkeys(extra or ()))
    for each in extras:
        if each not in EXTRAS:
            raise SetupError(
                _(
                    "--extra: expected one of {extras}, got {extra!r}",
                    extras=", ".join(EXTRAS),
                    extra=each,
                )
            )
    if importlib.util.find_spec("pip") is None:
        raise SetupError(
            _(
                "expected pip, which collects the packages, and this "
                "Python comes without it; install it with: python -m "
                "ensurepip (with uv: uvx --with pip ai4u-edu bundle "
                "FOLDER)"
            )
        )
    make_folder(folder, _("the bundle"))
    collect_wheels(folder / "wheels", extras, wheel)
    write_course(folder / "course")
    write_scenes(folder / "scenes")
    pythons = write_scripts(folder, extras)
    say(
        _(
            "{folder}: for Python {versions}; README.txt says how to start it",
            folder=str(folder),
            versions=", ".join(pythons),
        )
    )


def collect_wheels(folder: Path, extras: list[str], wheel: Path | None) -> None:
    """Put the wheels of the package and of all that it needs into a folder."""
    folder.mkdir(exist_ok=True)
    own = wheel or _build(folder)
    if wheel and wheel.parent.resolve() != folder.resolve():
        shutil.copy(wheel, folder)
    package = str(own) if own else f"ai4u-edu=={__version__}"
    options = ["--dest", str(folder), "--only-binary", ":all:", "--find-links", str(folder)]
    _pip("download", *options, package + (f"[{','.join(extras)}]" if extras else ""))


def _build(folder: Path) -> Path | None:
    """Build the wheel, if this is a clone; return its path."""
    root = Path(__file__).resolve().parents[2]
    if not (root / "pyproject.toml").is_file():
        return None
    for old in folder.glob("ai4u_edu-*.whl"):
        old.unlink()
    _pip("wheel", "--no-deps", "--wheel-dir", str(folder), str(root))
    return next(folder.glob("ai4u_edu-*.whl"))


def _pip(*words: str) -> None:
    command = [sys.executable, "-m", "pip", words[0], "--quiet", *words[1:]]
    done = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603 - pip
    if done.returncode:
        last = "\n".join(done.stderr.strip().splitlines()[-8:])
        raise SetupError(
            _("pip could not collect the packages; is there a network here?\n{last}", last=last)
        )


def write_course(folder: Path) -> None:
    """Write the notebooks of the course; those that are there already are kept."""
    from ai4u_edu.lessons.handout import hand_out

    hand_out(folder, catalogue().language)


def write_scenes(folder: Path) -> None:
    """Write the scenes of the library as files."""
    from ai4u_edu.scenes import Scene

    folder.mkdir(exist_ok=True)
    library = resources.files("ai4u_edu.scenes").joinpath("library")
    for name in Scene.names():
        path = folder / f"{name}.yaml"
        if not path.exists():
            write_atomically(path, library.joinpath(path.name).read_bytes())


def write_scripts(folder: Path, extras: list[str]) -> list[str]:
    """Write the start scripts; return the versions of Python that the bundle is for."""
    book = folder / "bundle.json"
    before = json.loads(book.read_text(encoding="utf-8")) if book.exists() else {}
    this = "{} {}.{}".format(sys.platform, *sys.version_info)
    made_on = sorted({this, *before.get("made_on", ())})
    pythons = sorted(
        {each.split()[1] for each in made_on}, key=lambda each: [int(n) for n in each.split(".")]
    )
    all_extras = sorted({*extras, *before.get("extras", ())})
    content = {"version": __version__, "made_on": made_on, "extras": all_extras}
    write_atomically(book, json.dumps(content, indent=1))
    for name in (*SCRIPTS, "README.txt"):
        text = resources.files(FILES).joinpath(name).read_text(encoding="utf-8")
        if name != "start.py":
            names = " ".join(f"python{each}" for each in reversed(pythons))
            text = re.sub(r"\bPYTHONS\b", names, text)
            text = re.sub(r"\bVERSIONS\b", " ".join(reversed(pythons)), text)
        text = text.replace("\r\n", "\n").replace("\n", SCRIPTS.get(name, "\n"))
        executable = name in {"start.sh", "start.command"}
        write_atomically(folder / name, text, mode=0o777 if executable else 0o666)
    return pythons
