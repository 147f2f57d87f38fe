"""`python3 -m ai4u_edu`: the command line, also from a fresh clone with a bare Python.

Standard library only, in a syntax that even Python 3.8 reads (see bootstrap.py).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from ai4u_edu import bootstrap
from ai4u_edu.bootstrap import _

ROOT = Path(__file__).resolve().parent.parent
AGAIN = "AI4U_EDU_RESTARTED"


def main() -> None:
    """Run the command line here if everything is installed, otherwise in the checkout's .venv."""
    restarted = os.environ.pop(AGAIN, None)
    missing = _missing()
    if missing is None:
        from ai4u_edu.cli.main import main as run

        run()
        return
    if not bootstrap.is_checkout(ROOT):
        sys.exit(
            _(
                "AI4U Edu needs the module {missing}, and {python} doesn't have it.\n"
                "Mend it with: pip install ai4u-edu",
                missing=missing,
                python=sys.executable,
            )
        )
    if restarted:
        sys.exit(
            _(
                "The module {missing} is missing even in {folder}.\n"
                "Delete .venv, then run the same command again.",
                missing=missing,
                folder=ROOT / ".venv",
            )
        )
    try:
        python = bootstrap.ensure(ROOT)
    except bootstrap.InstallError as error:
        sys.exit(str(error))
    except KeyboardInterrupt:
        sys.exit(_("Stopped; the next run goes on from here."))
    _restart(str(python))


def _missing() -> str | None:
    """Name something of other people's that this Python lacks, if there is anything."""
    if sys.version_info[:2] < bootstrap.OLDEST:
        return "tomllib"  # and our own code couldn't be read
    try:
        import ai4u_edu.cli.main  # noqa: F401 - for what it imports
    except ModuleNotFoundError as error:
        name = error.name or ""
        if name.partition(".")[0] == "ai4u_edu":
            raise
        return name
    return _not_installed() if bootstrap.is_checkout(ROOT) else None


def _not_installed() -> str | None:
    """Name a declared dependency that isn't installed: the command line imports some only late."""
    # Not in the Pythons that get a message instead.
    import tomllib
    from importlib import metadata

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for requirement in project.get("dependencies", []):
        name = re.split(r"[^\w.-]", requirement, maxsplit=1)[0]
        try:
            metadata.version(name)
        except metadata.PackageNotFoundError:
            return name
    return None


def _restart(python: str) -> None:
    command = [python, "-m", "ai4u_edu", *sys.argv[1:]]
    os.environ[AGAIN] = "1"
    if os.name == "nt":  # execv would hand the prompt back while the program still runs
        sys.exit(subprocess.call(command))  # noqa: S603 - our own words and the user's, no shell
    os.execv(python, command)  # noqa: S606 - the same


if __name__ == "__main__":
    main()
