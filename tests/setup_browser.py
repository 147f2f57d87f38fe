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
    announce()
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
    if on_ubuntu() and has_apt():
        return [[*playwright, "--with-deps"], playwright]
    return [*debians_ways(), playwright]


def debians_ways() -> list[list[str]]:
    """List the commands that install Debian's Chromium; none where they can't."""
    if on_ubuntu() or not has_apt():
        return []
    apt = [*(as_root() or []), "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    install = [*apt, "install", "-y", "--no-install-recommends"]
    return [[*apt, "update"], [*install, HEADLESS], [*install, "chromium"]]


def install_debians() -> None:
    """Install Debian's Chromium where there is none and that can be done, without Playwright.

    A failure is silent here; :func:`ensure` tries again, and says what went wrong.
    """
    if "AI4U_CHROMIUM" in os.environ or on_path():
        return
    commands = debians_ways()
    if commands:
        announce()
    for command in commands:
        run(command)
        if on_path():
            break


def announce() -> None:
    """Say what takes so long."""
    print("Getting Chromium for the tests (a few minutes, once) ...", flush=True)


def has_apt() -> bool:
    """Tell whether packages of the system can be installed without a password."""
    return shutil.which("apt-get") is not None and as_root() is not None


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
