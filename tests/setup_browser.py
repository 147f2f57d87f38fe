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


def ensure(python: Path, tried: list[str]) -> str:
    """Return the path of a Chromium, having Playwright install one if there is none.

    Args:
        python: the Python in whose environment Playwright is installed.
        tried: what :func:`install_debians` returned.

    Raises:
        BrowserError: none is there and none could be installed.
    """
    found = find(python)
    if found:
        return found
    for command in playwrights_ways(python):
        tried = tried + attempt(command)
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


def install_debians() -> list[str]:
    """Install Debian's Chromium if there is none and that can be done; return what was tried.

    It needs nothing of an environment of Python, so that both can be made at once.
    """
    tried: list[str] = []
    if "AI4U_CHROMIUM" in os.environ or on_path():
        return tried
    for command in debians_ways():
        tried += attempt(command)
        if on_path():
            break
    return tried


def attempt(command: list[str]) -> list[str]:
    """Run a command that may bring a Chromium; return lines about it for the error."""
    print(f"Getting Chromium for the tests: {' '.join(command)}", flush=True)
    code, output = run(command)
    why = output.strip().splitlines()[-5:] if code else []
    return ["  " + " ".join(command), *("    " + line for line in why)]


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


def playwrights_ways(python: Path) -> list[list[str]]:
    """List the commands by which Playwright may bring a Chromium, the best first."""
    install = [str(python), "-m", "playwright", "install", "chromium"]
    return [[*install, "--with-deps"], install] if on_ubuntu() and has_apt() else [install]


def debians_ways() -> list[list[str]]:
    """List the commands that install Debian's Chromium, the best first; none where they can't."""
    if on_ubuntu() or not has_apt():
        return []
    apt = [*(as_root() or []), "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    install = [*apt, "install", "-y", "--no-install-recommends"]
    return [[*apt, "update"], [*install, HEADLESS], [*install, "chromium"]]


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
