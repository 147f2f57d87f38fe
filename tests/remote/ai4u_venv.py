"""AI4U's Python package, as it is on PyPI, in an environment of its own: ``.venvs/ai4u``.

It pins an older NumPy and Gymnasium, so it can't be with ours. ``python -m tests.remote.ai4u_venv``
makes it, with stable-baselines3 and torch (about 1 GB) for AI4U's training script, which runs at
night only. Standard library only, in a syntax that Python 3.8 reads, see tests/__main__.py.
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
PACKAGES = ["ai4u==0.5.0"]
FOR_TRAINING = ["stable-baselines3>=2.7", "torch==2.13.0"]


class VenvError(Exception):
    """The environment can't be made; the text says why."""


def find(*, trains: bool = False) -> Path | None:
    """Return its Python, if it is there and has what it should.

    Args:
        trains: True asks for what AI4U's training script needs, too.
    """
    python = FOLDER / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    try:
        has = STAMP.read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    return python if set(_wanted(trains)) <= set(has) and python.exists() else None


def ensure(maker: Path, *, trains: bool = False) -> Path:
    """Return its Python, making it if it is not there.

    Args:
        maker: the Python to make it with.
        trains: see :func:`find`.

    Raises:
        VenvError: something stands in the way.
    """
    found = find(trains=trains)
    if found:
        return found
    print("Getting AI4U's own Python package for the tests (once) ...", flush=True)
    STAMP.unlink(missing_ok=True)
    run([str(maker), "-m", "venv", "--clear", str(FOLDER)])
    python = FOLDER / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    folder, *packages = _wanted(trains)
    run([str(python), *PIP_INSTALL, *packages])
    STAMP.write_text("\n".join([folder, *packages]), encoding="utf-8")
    return python


def _wanted(trains: bool) -> list[str]:
    """Return the lines that the stamp of a finished environment has."""
    return [str(FOLDER), *PACKAGES, *(FOR_TRAINING if trains else [])]


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
        print(ensure(Path(sys.executable), trains=True))
    except VenvError as error:
        sys.exit(str(error))
