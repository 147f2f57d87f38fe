"""AI4U's Python package, as it is on PyPI, in an environment of its own: ``.venvs/ai4u``.

It pins an older NumPy and Gymnasium, so it can't be with ours. stable-baselines3 and torch are
there too, for the training script; about 1 GB. ``python -m tests.remote.ai4u_venv`` makes it.
Standard library only, in a syntax that Python 3.8 reads, see tests/__main__.py.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from ai4u_edu.bootstrap import PIP_INSTALL

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / ".venvs" / "ai4u"
STAMP = FOLDER / "made-of.txt"
PACKAGES = ["ai4u==0.5.0", "stable-baselines3>=2.7", "torch==2.13.0"]


class VenvError(Exception):
    """The environment can't be made; the text says why."""


def find() -> Path | None:
    """Return its Python, if it is there and made of what it should be."""
    python = FOLDER / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    try:
        fits = STAMP.read_text(encoding="utf-8") == wanted()
    except OSError:
        return None
    return python if fits and python.exists() else None


def ensure(maker: Path) -> Path:
    """Return its Python, making it if it is not there.

    Args:
        maker: the Python to make it with.

    Raises:
        VenvError: something stands in the way.
    """
    found = find()
    if found:
        return found
    print("Getting AI4U's own Python package for the tests (a few minutes, once) ...", flush=True)
    STAMP.unlink(missing_ok=True)
    run([str(maker), "-m", "venv", "--clear", str(FOLDER)])
    python = FOLDER / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    run([str(python), *PIP_INSTALL, *PACKAGES])
    STAMP.write_text(wanted(), encoding="utf-8")
    return python


def wanted() -> str:
    """Return what the stamp of a finished environment says."""
    return "\n".join([str(FOLDER), *PACKAGES])


def run(command: list[str]) -> None:
    """Run a command; one that fails ends in an error with what it said."""
    done = subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    if done.returncode:
        said = ["    " + line for line in done.stdout.strip().splitlines()[-8:]]
        raise VenvError(
            "\n".join(["AI4U's Python package couldn't be had:", " ".join(command), *said])
        )


if __name__ == "__main__":
    try:
        print(ensure(Path(sys.executable)))
    except VenvError as error:
        sys.exit(str(error))
