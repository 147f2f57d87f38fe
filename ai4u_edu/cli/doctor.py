"""The command ``ai4u-edu doctor``: a report of what is installed and what is missing for what.

What it prints is meant for a bug report, so it names neither folders nor people nor hosts.
"""

import os
import platform
import re
import shutil
import socket
import sys
from collections.abc import Iterator
from importlib import metadata
from typing import Annotated, NamedTuple

import typer

from ai4u_edu.base.version import __version__
from ai4u_edu.cli.options import say
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

PACKAGE = "ai4u-edu"
SWITCH_VARIABLE = "AI4U_COMPILED"
REINSTALL = f"pip install --force-reinstall {PACKAGE}"
PORT = 8080
"""The port that `play` uses unless told otherwise."""
USES = {
    "data": "episodes as a dataset of Minari",
    "hub": "a class on a JupyterHub",
    "lessons": "the course of notebooks",
    "multi": "PettingZoo's interface",
    "ray": "jobs on several machines",
    "sweep": "comparing many trainings",
    "tournament": "tournaments of networks and programs",
    "train": "training networks with Stable-Baselines3",
    "video": "episodes as MP4",
}
"""Purpose of each extra."""
BROWSERS = "firefox", "chromium", "chromium-browser", "google-chrome", "microsoft-edge", "brave"
"""Programs that are searched for on Linux."""
SHOWN_VERSIONS = "gymnasium", "numpy", "pymunk", "starlette", "uvicorn", "viser", "websockets"


class DoctorFinding(NamedTuple):
    """One line of the report."""

    subject: str
    state: str
    advice: str = ""
    """Sentence that says how to mend it; empty if all is well."""


def doctor(
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="The port that the page will use.")
    ] = PORT,
) -> None:
    """Say what is installed and what is missing, as a block for a bug report."""
    findings = list(examine(port))
    # the block stays English, for whoever reads the report; the advice is for its sender
    typer.echo("```")
    for each in findings:
        typer.echo(f"{each.subject + ':':<16}{each.state}")
    typer.echo("```")
    for each in findings:
        if each.advice:
            say(join([each.subject, each.advice], ": "))
    if any(each.subject == "packages" and each.advice for each in findings):
        raise typer.Exit(1)


def examine(port: int) -> Iterator[DoctorFinding]:
    """Give the findings of a report.

    Args:
        port: that the page will use.
    """
    yield DoctorFinding("AI4U Edu", f"{__version__} ({_installation()})")
    yield DoctorFinding(
        "Python", f"{platform.python_version()} ({platform.python_implementation()})"
    )
    yield DoctorFinding("system", f"{_system()}, {platform.machine()}")
    versions = {name: _version(name) for name in SHOWN_VERSIONS}
    shown = (f"{name} {version}" for name, version in versions.items() if version)
    yield DoctorFinding("versions", ", ".join(shown))
    yield _packages()
    yield _compiled_part()
    for extra, use in USES.items():
        yield _extra(extra, use)
    yield _port(port)
    yield _browser()
    encoding = getattr(sys.stdout, "encoding", None) or "unknown"
    yield DoctorFinding("console", f"encoding {encoding}")


def _installation() -> str:
    """Return how this copy came here, without the folder's name."""
    try:
        distribution = metadata.distribution(PACKAGE)
    except metadata.PackageNotFoundError:
        return "not installed, run from a folder"
    origin = distribution.read_text("direct_url.json") or ""
    return "editable, from a clone" if re.search(r'"editable":\s*true', origin) else "wheel"


def _system() -> str:
    """Return the system's name and version, without the machine's."""
    if platform.system() == "Linux":
        try:
            name = platform.freedesktop_os_release()["PRETTY_NAME"]
        except (OSError, KeyError):
            name = "Linux"
        return f"{name}, {platform.libc_ver()[0] or 'other libc'} {platform.libc_ver()[1]}".strip()
    if platform.system() == "Darwin":
        return f"macOS {platform.mac_ver()[0]}"
    return f"{platform.system()} {platform.release()}"


def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


def requirements(extra: str = "") -> list[str]:
    """Return the names of the packages that the package or one of its extras asks for.

    Those of other extras that the extra includes are among them.
    """
    try:
        lines = metadata.requires(PACKAGE) or []
    except metadata.PackageNotFoundError:
        return []
    names = []
    for line in lines:
        requirement, _, marker = line.partition(";")
        of = re.search(r"""extra == ['"]([\w-]+)['"]""", marker)
        if (of.group(1) if of else "") != extra:
            continue
        name = re.split(r"[^\w.-]", requirement.strip(), maxsplit=1)[0]
        included = re.search(r"\[([\w,-]+)\]", requirement)
        if name == PACKAGE and included:
            names += [each for part in included.group(1).split(",") for each in requirements(part)]
        else:
            names.append(name)
    return names


def _packages() -> DoctorFinding:
    missing = [name for name in requirements() if not _version(name)]
    if not missing:
        return DoctorFinding("packages", "all that are needed are installed")
    return DoctorFinding(
        "packages",
        f"missing: {', '.join(missing)}",
        _("install it again: {command}", command=REINSTALL),
    )


def _compiled_part() -> DoctorFinding:
    from ai4u_edu.world.native import IS_NATIVE, is_compiled

    if is_compiled():
        return DoctorFinding("compiled part", "in use")
    if os.environ.get(SWITCH_VARIABLE) == "0":
        return DoctorFinding(
            "compiled part",
            "switched off",
            _("it is used without {setting}", setting=f"{SWITCH_VARIABLE}=0"),
        )
    if not IS_NATIVE:
        return DoctorFinding(
            "compiled part",
            "not used: another pymunk than the tested one",
            _("all numbers are right, and rays slower; {command}", command=REINSTALL),
        )
    return DoctorFinding(
        "compiled part",
        "missing",
        _(
            "all numbers are right, and rays take up to twice as long; there is a wheel with it "
            "for most systems, and in a clone with a C compiler: pip install -e ."
        ),
    )


def _extra(extra: str, use: str) -> DoctorFinding:
    names = requirements(extra)
    missing = [name for name in names if not _version(name)]
    subject = f"[{extra}]"
    if names and not missing:
        return DoctorFinding(subject, f"installed, for {use}")
    if len(missing) < len(names):
        lacks = f"in part, for {use}; missing: {', '.join(missing)}"
        complete = f'pip install "{PACKAGE}[{extra}]"'
        return DoctorFinding(subject, lacks, _("complete it with: {command}", command=complete))
    return DoctorFinding(subject, f"not installed, would be for {use}")


def _port(port: int) -> DoctorFinding:
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        if os.name == "posix":  # elsewhere it would let two programs share a port
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return DoctorFinding(
                f"port {port}",
                "taken",
                _("another program, or AI4U Edu, has it; play --port 0"),
            )
    return DoctorFinding(f"port {port}", "free")


def _browser() -> DoctorFinding:
    if sys.platform in {"win32", "darwin"}:
        return DoctorFinding("browser", "the system's")
    found = [name for name in BROWSERS if shutil.which(name)]
    has_desktop = any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))
    desktop = "a desktop" if has_desktop else "no desktop"
    if found and has_desktop:
        return DoctorFinding("browser", f"{', '.join(found)}; {desktop}")
    return DoctorFinding(
        "browser",
        f"{', '.join(found) or 'none found'}; {desktop}",
        _(
            "open the address that `play` prints in a browser, here or on another machine (then "
            "with --host)"
        ),
    )
