"""`python3 -m tests`: every check of the project, from a fresh clone with a bare Python.

``python3 -m tests --only mypy`` runs one of them; other arguments go to pytest, which then runs
alone: ``python3 -m tests -k cycle``. Standard library only, in a syntax that Python 3.8 reads.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

from ai4u_edu import bootstrap
from tests import setup_browser
from tests.remote import ai4u_venv

ROOT = Path(__file__).resolve().parent.parent
LINT_IMPORTS = "from importlinter.cli import lint_imports_command as run; run()"
# Through `python -m`, since scripts in .venv/bin don't survive a move of the checkout.
CHECKS = {
    "ruff format": ["-m", "ruff", "format", "--check", "."],
    "ruff check": ["-m", "ruff", "check", "."],
    "mypy": ["-m", "mypy"],
    "imports": ["-c", LINT_IMPORTS],
    # What needs the machine to itself (see conftest.py), then all else on every core.
    "pytest alone": ["-m", "pytest", "-m", "alone"],
    "pytest": ["-m", "pytest", "-m", "not alone", "-n", "auto"],
}


def main() -> int:
    """Run the checks, all of them even if one fails; return the exit code."""
    parser = argparse.ArgumentParser(prog="python3 -m tests", allow_abbrev=False)
    tools = sorted({name.split()[0] for name in CHECKS})
    parser.add_argument("--only", choices=tools, help="run this one alone")
    options, for_pytest = parser.parse_known_args()
    only = options.only or ("pytest" if for_pytest else "")
    if for_pytest and only != "pytest":
        parser.error(f"{only} takes no arguments here, and got: {' '.join(for_pytest)}")

    try:
        python = bootstrap.ensure(ROOT, ["dev"])
    except bootstrap.SetupError as error:
        sys.exit(str(error))
    failed = []
    for name, command in CHECKS.items():
        if only and name.split()[0] != only:
            continue
        if name == "pytest alone":
            failed += prepare(python)
            if for_pytest:  # a few tests, chosen by hand
                return subprocess.call([str(python), "-m", "pytest", *for_pytest], cwd=ROOT)
            if "browser" in failed:
                command = [*command, "-m", "alone and not browser"]
        if not passes(name, [str(python), *command]):
            failed.append(name)
    if failed:
        print(f"\nNot in order: {', '.join(failed)}", flush=True)
    return 1 if failed else 0


def prepare(python: Path) -> list[str]:
    """Get what tests need besides Python's packages; return what could not be had."""
    missing = []
    try:
        os.environ["AI4U_CHROMIUM"] = setup_browser.ensure(python)
    except setup_browser.BrowserError as error:
        print(f"\n{error}\nGoing on without the tests that need a browser.", flush=True)
        missing.append("browser")
    try:
        ai4u_venv.ensure(python)
    except ai4u_venv.VenvError as error:
        print(f"\n{error}\nGoing on without the tests that need it.", flush=True)
        missing.append("AI4U's package")
    return missing


def passes(name: str, command: list[str]) -> bool:
    """Run one check under a heading, and say how long it took; pytest has the last word itself."""
    print(f"\n--- {name}", flush=True)
    start = time.monotonic()
    code = subprocess.call(command, cwd=ROOT)
    seconds = time.monotonic() - start
    if name != "pytest":
        print(f"--- {name}: {'FAILED' if code else 'ok'} in {seconds:.1f} s", flush=True)
    return code == 0


if __name__ == "__main__":
    sys.exit(main())
