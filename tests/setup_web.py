"""Gets the tools that check the page's scripts. Standard library only, see __main__.py.

They are for development alone: neither the page nor a test in Python needs them.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
from pathlib import Path

OLDEST_NODE = (20, 19)
"""Oldest version with which eslint and the tests' runner work."""
MAX_OUTPUT_CHARS = 2000
"""Length of npm's output that is shown if it fails."""


class WebToolsError(Exception):
    """The tools can't be had; the text says why and how to mend it."""


def ensure(root: Path) -> dict[str, list[str]]:
    """Return the commands that check ``web/`` by name; have npm install their tools if need be.

    When the lock file has not changed, this costs one start of Node.js.

    Raises:
        WebToolsError: Node.js or npm is missing or too old, or npm could not install the tools.
    """
    node = find("node")
    done = subprocess.run(
        [node, "--version"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        check=False,
    )
    version = tuple(map(int, re.findall(r"\d+", done.stdout)[:2]))
    if version < OLDEST_NODE:
        raise WebToolsError(
            f"Expected Node.js {'.'.join(map(str, OLDEST_NODE))} or newer to check web/, found "
            f"{done.stdout.strip() or 'one that does not start'} at {node}. Install a newer one."
        )
    web = root / "web"
    install(web)
    tools = web / "node_modules"
    tsc = [node, str(tools / "typescript" / "bin" / "tsc"), "--project"]
    eslint = [str(tools / "eslint" / "bin" / "eslint.js"), "--config", "web/eslint.config.js"]
    tests = sorted(str(path) for path in (root / "tests" / "web").rglob("*.test.mjs"))
    return {
        "web types": [*tsc, "web"],
        "web all types": [*tsc, "web/tsconfig.typed.json"],
        "web lint": [node, *eslint, "--max-warnings=0", "web", "tests/web"],
        "web tests": [node, "--test", "--test-reporter=dot", *tests],
    }


def install(web: Path) -> None:
    """Have npm install what ``package-lock.json`` names into ``node_modules``, unless it is there.

    Raises:
        WebToolsError: npm is missing, or failed.
    """
    stamp = web / "node_modules" / ".ai4u-edu"
    wanted = hashlib.sha256((web / "package-lock.json").read_bytes()).hexdigest()
    if stamp.is_file() and stamp.read_text() == wanted:
        return
    command = [find("npm"), "ci"]
    done = subprocess.run(
        command, cwd=web, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    if done.returncode:
        raise WebToolsError(
            "Expected npm to install the tools that check web/ (npm ci in web/), and it failed:\n"
            f"{done.stdout[-MAX_OUTPUT_CHARS:]}"
        )
    stamp.write_text(wanted)


def find(name: str) -> str:
    """Return the path of a program of Node.js.

    Raises:
        WebToolsError: it is missing.
    """
    path = shutil.which(name)
    if path is None:
        raise WebToolsError(
            f"Expected {name} on PATH to check the page's scripts in web/, found none. Install "
            "Node.js (on Debian: sudo apt install nodejs npm)."
        )
    return path
