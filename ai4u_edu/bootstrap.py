"""Set-up of `.venv` beside pyproject.toml, with the project installed into it.

Standard library only, in a syntax that even Python 3.8 reads: this file tells the owner of an old
Python what to do.
"""

from __future__ import annotations

import gettext
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

OLDEST = (3, 11)
COMPILED = "ai4u_edu/world/native/rays.c"
"""Source of the part that the installation compiles, where there is a compiler."""
TORCH = "torch==2.13.0"
WITH_TORCH = {"dev", "train"}
# Python compiles a module when it is first imported. To compile all of them takes half the time.
PIP_INSTALL = ["-m", "pip", "install", "--quiet", "--no-input", "--no-compile"]


def _translations() -> gettext.NullTranslations:
    """Return the catalogue of the terminal's language; ai4u_edu.locale needs a newer Python."""
    words = sys.argv[1:]
    options = [
        word.partition("=")[2] or "".join(words[at + 1 : at + 2])
        for at, word in enumerate(words)
        if word.partition("=")[0] == "--lang"
    ]
    names = ("AI4U_LANG", "LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG")
    wanted = [code for name in names for code in os.environ.get(name, "").split(":")]
    folder = Path(__file__).resolve().parent / "locale"
    for code in filter(None, options + wanted):
        short = code.partition(".")[0].replace("-", "_").partition("_")[0].lower()
        if short == "en":
            break
        for file in sorted(folder.glob("*/LC_MESSAGES/ai4u_edu.mo")):
            if file.parts[-3].partition("_")[0] == short:
                with file.open("rb") as opened:
                    return gettext.GNUTranslations(opened)
    return gettext.NullTranslations()


def _(text: str, **values: object) -> str:
    """Return a sentence in the terminal's language, with its values."""
    return _translations().gettext(text).format(**values)


class InstallError(Exception):
    """The environment can't be made; the text says why and how to mend it."""


def is_checkout(root: Path) -> bool:
    """Return True if `root` is our source tree; a stray pyproject.toml elsewhere is not."""
    try:
        return 'name = "ai4u-edu"' in (root / "pyproject.toml").read_text(encoding="utf-8")
    except OSError:
        return False


def ensure(root: Path, extras: Sequence[str] = ()) -> Path:
    """Make or mend `root/.venv` with the project and its `extras` inside, and return its Python.

    Extras add up: one that was installed earlier stays. When nothing changed, this costs one start
    of Python.

    Raises:
        InstallError: something stands in the way.
    """
    if not is_checkout(root):
        raise InstallError(
            _(
                "Expected AI4U Edu's pyproject.toml in {root}, and it isn't there.\n"
                "Run the command in the folder that `git clone` made.",
                root=root,
            )
        )
    venv = root / ".venv"
    python = venv / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    stamp = venv / "ai4u-edu.json"
    version = _version(venv, python)
    before = _read(stamp)
    wanted: dict[str, Any] = {
        "root": str(root.resolve()),
        "pyproject": _checksum(root / "pyproject.toml"),
        "compiled": _checksum(root / COMPILED),
        "extras": sorted({*extras, *before.get("extras", [])}),
        "python": version,
    }
    if version and before == wanted:
        return python

    _check_age(version)
    _say(_("Setting up AI4U Edu in .venv (about a minute, once) ..."))
    _begin(venv, stamp, before)
    _give_pip(venv, python, version)
    _install(root, python, wanted["extras"])
    wanted["python"] = _version(venv, python)
    if not wanted["python"]:
        raise InstallError(
            _(
                "Expected {python} to start, and it doesn't; start it by hand to see why.",
                python=python,
            )
        )
    stamp.write_text(json.dumps(wanted), encoding="utf-8")
    _say(_("Done."))
    return python


def _say(text: str) -> None:
    sys.stderr.write(text + "\n")
    sys.stderr.flush()


def _read(stamp: Path) -> dict[str, Any]:
    try:
        found = json.loads(stamp.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else ""


def _version(venv: Path, python: Path) -> list[int]:
    """Return the version of the Python in `venv`, or nothing if it doesn't work there."""
    # Without its pyvenv.cfg it would start, and would install into the system's Python.
    here = "import os, sys; os.path.samefile(sys.prefix, sys.argv[1]) or sys.exit(1); "
    done = _run(python, "-I", "-c", here + "print(*sys.version_info[:3])", str(venv))
    return [] if done.returncode else [int(part) for part in done.stdout.split()[-3:]]


def _check_age(version: list[int]) -> None:
    oldest = "{}.{}".format(*OLDEST)
    if version and tuple(version[:2]) < OLDEST:
        raise InstallError(
            _(
                "AI4U Edu needs Python {oldest} or newer; the folder .venv holds Python "
                "{version}.\nDelete .venv, then run the same command with a newer Python.",
                oldest=oldest,
                version=".".join(map(str, version)),
            )
        )
    if not version and sys.version_info[:2] < OLDEST:
        raise InstallError(
            _(
                "AI4U Edu needs Python {oldest} or newer; this is Python {version} ({file}).\n"
                "Install a newer one (python.org has them for every system), then run the same "
                "command with it, for example with `python3.12` in place of `python3`.",
                oldest=oldest,
                version="{}.{}.{}".format(*sys.version_info[:3]),
                file=sys.executable,
            )
        )


def _begin(venv: Path, stamp: Path, before: dict[str, Any]) -> None:
    """Make the folder, with a stamp that matches nothing until the work is done."""
    try:
        venv.mkdir(exist_ok=True)
        stamp.write_text(json.dumps({"extras": before.get("extras", [])}), encoding="utf-8")
    except OSError as error:
        raise InstallError(
            _(
                "Expected to write into {venv}, and couldn't: {problem}.\n"
                "Move AI4U Edu into a folder of your own. If .venv is somebody else's, delete it.",
                venv=venv,
                problem=error.strerror,
            )
        ) from error


def _give_pip(venv: Path, python: Path, version: list[int]) -> None:
    """Make sure that pip runs in the environment; never replace a Python that works."""
    if version and not _run(python, "-m", "pip", "--version").returncode:
        return
    maker = python if version else Path(sys.executable)
    if _run(maker, "-c", "import ensurepip, venv").returncode:
        raise InstallError(
            _(
                "Expected Python's own modules venv and ensurepip, and {python} comes without "
                "them.\nOn Debian and Ubuntu: sudo apt install python3-venv\n"
                "Elsewhere: install Python from python.org. Then run the same command again.",
                python=maker,
            )
        )
    if version:  # made by a tool that leaves pip out, or killed before pip came
        done = _run(python, "-m", "ensurepip", "--upgrade")
    else:
        clear = ["--clear"] if (venv / "pyvenv.cfg").exists() else []
        done = _run(maker, "-m", "venv", *clear, str(venv))
    _check(done, _("Making .venv failed."), _("Delete .venv, then run the same command again."))


def _install(root: Path, python: Path, extras: list[str]) -> None:
    if WITH_TORCH.intersection(extras) and _declares_torch(root):
        _bring_torch(python)
    project = "." + ("[{}]".format(",".join(extras)) if extras else "")
    done = _run(python, *PIP_INSTALL, "-e", project, cwd=root)
    _check(
        done,
        _("pip couldn't install AI4U Edu's packages."),
        _(
            "They come over the network: see that it works, then run the same command again. "
            "If that doesn't help, delete .venv first."
        ),
    )


def _declares_torch(root: Path) -> bool:
    return '"torch' in (root / "pyproject.toml").read_text(encoding="utf-8")


def _bring_torch(python: Path) -> None:
    """Install a torch that the tests know, if there is none yet.

    Where it can't be had, the project's own requirement brings another.
    """
    look = "import sys; from importlib.util import find_spec; sys.exit(not find_spec('torch'))"
    if _run(python, "-c", look).returncode:
        # Python 3.11's own pip takes 27 s to choose versions of all packages, a newer one 10 s
        _run(python, *PIP_INSTALL, "--upgrade", "pip")
        _run(python, *PIP_INSTALL, TORCH)


def _run(python: Path, *args: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run Python with stdout and stderr in one text; one that can't start has failed."""
    command = [str(python), *args]
    try:
        return subprocess.run(  # noqa: S603 - our own words and a path in the checkout, no shell
            command,
            cwd=cwd,
            env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            check=False,
        )
    except OSError as error:
        return subprocess.CompletedProcess(command, 1, str(error))


def _check(done: subprocess.CompletedProcess[str], what: str, mend: str) -> None:
    if done.returncode:
        lines = done.stdout.strip().splitlines()[-15:]
        raise InstallError("\n".join([what, *("  " + line for line in lines), mend]))
