"""Systems that the compiled part is compiled for here, and how their programs are started."""

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from tests.world.vectors.record import record

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / ".ci" / "compile_rays.py"
PROGRAM = Path(__file__).with_name("replay.c")
VECTORS = "vectors.bin"
START_TIMEOUT_S = 300.0
"""Timeout (s) of a program; the first start of wine makes its folder, in some ten seconds."""


class Target(NamedTuple):
    """A system and processor."""

    platform: str
    """Name that Python has for it."""
    compiler: str
    starter: tuple[str, ...] = ()
    """The command that runs its programs here."""
    libraries: tuple[str, ...] = ("-ldl",)


TARGETS = {
    "this machine": Target(f"{sys.platform}-{platform.machine()}", "cc"),
    "Windows on x86-64": Target("win-amd64", "x86_64-w64-mingw32-gcc", ("wine",), ()),
    "Linux on ARM": Target(
        "linux-aarch64", "aarch64-linux-gnu-gcc", ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu")
    ),
    "Linux with musl": Target("linux-x86_64", "musl-gcc", (), ()),
}


def missing_tools(name: str) -> list[str]:
    """Return the programs that a target needs and that are not installed."""
    target = TARGETS[name]
    return [each for each in (target.compiler, *target.starter[:1]) if shutil.which(each) is None]


def replay(name: str, folder: Path) -> tuple[bool, str]:
    """Compile library and program for a target, and replay all calls.

    Args:
        name: of the target.
        folder: for what is made; the vectors are recorded once for all targets.

    Returns:
        True if all bits are the same, and what the program printed.
    """
    vectors = folder / VECTORS
    if not vectors.exists():
        vectors.write_bytes(record().packed())
    target, here = TARGETS[name], folder / name.replace(" ", "-")
    here.mkdir(exist_ok=True)
    library = make_library(target, here)
    program = here / "replay.exe"
    command: list[str | Path] = [
        target.compiler,
        "-std=c11",
        "-O1",
        "-o",
        program,
        PROGRAM,
        *target.libraries,
    ]
    subprocess.run(command, check=True)
    done = subprocess.run(
        [*target.starter, program, f"./{library.name}", Path("..", VECTORS)],
        cwd=here,
        env={**os.environ, "WINEPREFIX": str(here / "wine"), "WINEDEBUG": "-all"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=START_TIMEOUT_S,
        check=False,
    )
    return done.returncode == 0, (done.stdout.splitlines() or ["nothing"])[-1]


def make_library(target: Target, folder: Path) -> Path:
    """Compile the library as the wheel's build does."""
    environment = {**os.environ, "CC": target.compiler, "_PYTHON_HOST_PLATFORM": target.platform}
    done = subprocess.run(
        [sys.executable, SCRIPT, folder],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return Path(done.stdout.strip())
