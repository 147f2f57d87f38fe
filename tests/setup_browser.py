"""Finds a Chromium for the tests, or gets one. Standard library only, see __main__.py."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

MANAGED = """
from playwright.sync_api import sync_playwright
with sync_playwright() as playwright:
    print(playwright.chromium.executable_path)
"""


HEADLESS = "chromium-headless-shell"
"""Debian's Chromium without windows and menus, which takes a third less processor time in tests."""


class BrowserError(Exception):
    """There is no Chromium and none could be had; the text says what was tried."""


def ensure(python: Path) -> str:
    """Return the path of a Chromium, installing one if there is none.

    Args:
        python: the Python in whose environment Playwright is installed.

    Raises:
        BrowserError: none is there and none could be installed.
    """
    found = find(python)
    if found:
        return found
    print("Getting Chromium for the tests (a few minutes, once) ...", flush=True)
    tried = []
    for command in ways(python):
        tried.append("  " + " ".join(command))
        code, output = run(command)
        if code:
            tried += ["    " + line for line in output.strip().splitlines()[-5:]]
        found = find(python)
        if found:
            return found
    raise BrowserError(
        "\n".join(
            [
                "Expected Chromium for the tests in a browser: at AI4U_CHROMIUM, on PATH, or",
                "Playwright's own. Found none, and these commands didn't bring it:",
                *tried,
                "Install Chromium or Chrome (on Debian: sudo apt install chromium),",
                "or set AI4U_CHROMIUM to the program's path.",
            ]
        )
    )


def find(python: Path) -> str | None:
    """Return the path of a Chromium that is here already."""
    given = os.environ.get("AI4U_CHROMIUM")
    if given:
        if not shutil.which(given):
            raise BrowserError(
                f"AI4U_CHROMIUM is {given!r}, and that is no program. Mend or unset it."
            )
        return given
    path = on_path()
    if path:
        return path
    code, output = run([str(python), "-c", MANAGED])
    path = output.strip().rpartition("\n")[-1]
    return path if code == 0 and Path(path).exists() else None


def on_path() -> str | None:
    """Return the path of the Chromium of the system, without a window if there is one."""
    names = [HEADLESS, "chromium", "chromium-browser", "google-chrome"]
    if on_ubuntu():  # its Chromium is a snap, whose confinement Playwright can't work with
        names = ["google-chrome"]
    return next(filter(None, map(shutil.which, names)), None)


def ways(python: Path) -> list[list[str]]:
    """List the commands that may bring a Chromium, the best first."""
    playwright = [str(python), "-m", "playwright", "install", "chromium"]
    admin = as_root()
    if admin is None or not shutil.which("apt-get"):
        return [playwright]
    if on_ubuntu():
        return [[*playwright, "--with-deps"], playwright]
    apt = [*admin, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    install = [*apt, "install", "-y", "--no-install-recommends"]
    return [[*apt, "update"], [*install, HEADLESS], [*install, "chromium"], playwright]


def as_root() -> list[str] | None:
    """Return what to put before a command to run it as root; None if that takes a password."""
    if not hasattr(os, "geteuid"):
        return None
    if os.geteuid() == 0:
        return []
    sudo = ["sudo", "-n"]
    return sudo if run([*sudo, "true"])[0] == 0 else None


def on_ubuntu() -> bool:
    """Tell whether this is Ubuntu itself; its relatives ship a real Chromium."""
    release = Path("/etc/os-release")
    return release.exists() and "ID=ubuntu" in release.read_text(encoding="utf-8").splitlines()


def run(command: list[str]) -> tuple[int, str]:
    """Run a command and return its exit code and what it said."""
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            check=False,
        )
    except OSError as error:
        return 1, str(error)
    return done.returncode, done.stdout
