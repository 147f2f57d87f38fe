"""Compile rays.c into the package: ``python .ci/compile_rays.py``, or into a FOLDER.

The wheel's build does the same; see wheel_hook.py. Standard library only.

Variables of the environment: ``CC`` names a compiler that understands GCC's options, and
``_PYTHON_HOST_PLATFORM`` (as ``win-amd64`` or ``linux-aarch64``) the platform that it compiles for.
"""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NATIVE = ROOT / "ai4u_edu" / "world" / "native"
COMPILERS = "cc", "gcc", "clang"
FLAGS = (
    "-std=c11",
    "-O2",
    "-ffp-contract=off",  # a * b + c is rounded twice, as in Python
    "-fvisibility=hidden",
    "-shared",
)
COMPILER_TIMEOUT_S = 60.0
"""Timeout (s) of the compiler; it takes a tenth of a second."""


class CompileError(Exception):
    """The library can't be made; the text says why."""


def target_platform() -> str:
    """Return the platform that the library is made for, as ``linux-x86_64``."""
    return os.environ.get("_PYTHON_HOST_PLATFORM") or sysconfig.get_platform()


def library_name(platform: str) -> str:
    """Return the name of the library's file, which holds a hash of rays.c."""
    path = NATIVE / "compiled.py"
    spec = importlib.util.spec_from_file_location("compiled", path)
    if spec is None or spec.loader is None:
        raise CompileError(f"Expected a Python module in {path}, and it can't be loaded.")
    compiled = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(compiled)
    return str(compiled.library_name("nt" if platform.startswith("win") else "posix"))


def compile_library(folder: Path) -> Path:
    """Compile the library into a folder, and return its path.

    An atomic rename shows other processes all of it or nothing.

    Raises:
        CompileError: there is no compiler, or it fails.
    """
    platform = target_platform()
    command = [*find_compiler(), *FLAGS, *platform_flags(platform)]
    path = folder / library_name(platform)
    with tempfile.TemporaryDirectory(dir=folder) as made_in:
        # on a Mac the file's name is part of its signature, and has to be the final one
        made = Path(made_in) / path.name
        _run([*command, "-o", str(made), str(NATIVE / "rays.c")])
        if not made.exists():
            raise CompileError(f"{command[0]} succeeded, and made no library.")
        made.replace(path)
    return path


def compile_in_place() -> Path:
    """Compile the library beside its source, for a checkout; return its path."""
    path = compile_library(NATIVE)
    for old in NATIVE.glob("rays-*"):
        if old != path:
            old.unlink(missing_ok=True)
    return path


def find_compiler() -> list[str]:
    """Return the command that starts the C compiler.

    Raises:
        CompileError: there is none.
    """
    if os.environ.get("CC"):
        return shlex.split(os.environ["CC"], posix=os.name == "posix")
    found = next(filter(None, map(shutil.which, COMPILERS)), None)
    if found is None:
        raise CompileError(f"Expected a C compiler ({', '.join(COMPILERS)}), and found none.")
    if sys.platform == "darwin":
        # on a Mac without developer tools, cc opens a window that offers to install them
        _run(["/usr/bin/xcode-select", "-p"])
    return [found]


def platform_flags(platform: str) -> list[str]:
    """Return the compiler's options for a platform."""
    if platform.startswith("win"):  # the linker's timestamp would make each build another file
        return ["-s", "-static-libgcc", "-Wl,--no-insert-timestamp"]
    if platform.startswith("macosx"):
        _, version, machine = platform.split("-", 2)
        machines = ["x86_64", "arm64"] if machine == "universal2" else [machine]
        arches = [word for each in machines for word in ("-arch", each)]
        return ["-fPIC", f"-mmacosx-version-min={version}", *arches]
    return ["-s", "-fPIC"]


def _run(command: list[str]) -> None:
    try:
        done = subprocess.run(  # noqa: S603 - a compiler, our own words and paths, no shell
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=COMPILER_TIMEOUT_S,
            text=True,
            errors="replace",
            check=False,
        )
    except (OSError, subprocess.SubprocessError) as error:
        raise CompileError(f"Expected to run {command[0]}, and could not: {error}") from error
    if done.returncode:
        raise CompileError(f"{command[0]} failed with status {done.returncode}:\n{done.stdout}")


if __name__ == "__main__":
    try:
        print(compile_library(Path(sys.argv[1])) if sys.argv[1:] else compile_in_place())
    except CompileError as error:
        sys.exit(str(error))
