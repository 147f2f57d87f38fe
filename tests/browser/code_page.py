"""A page in which tests call the engine of a student's program and the client of a world."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu.page.server import web_files
from tests.browser.plain_page import WITHOUT_VISER
from tests.chromium import new_page
from tests.waiting import LIMIT_MS, LIMIT_S

HOST = """
import json

names = {}

def translate(catalogue):
    pass

def watch(report):
    pass

def load(text):
    names.clear()
    exec(json.loads(text)["source"], names)
    return json.dumps({"ok": True})

def begin():
    return json.dumps({"ok": True})

def decide(text):
    said = json.loads(text)
    try:
        return json.dumps({"ok": True, "values": names["decide"](said["percept"]), "said": said})
    except BaseException as error:
        return json.dumps({"ok": False, "text": f"{type(error).__name__}: {error}", "line": 0})
"""
"""Stand-in for ai4u_edu/program/host.py. It runs any code, so that only the worker forbids."""
ROOM = {
    "outputs": {"move": [[-1, -1], [1, 1]]},
    "readings": [{"key": "reading", "dtype": "<f4"}],
}
"""Actuators and readings that a program is loaded for."""
PATIENT = {
    "programS": LIMIT_S,
    "callMs": LIMIT_MS,
    "beginMs": LIMIT_MS,
    "connectMs": LIMIT_MS,
    "outcomeMs": LIMIT_MS,
    "openMs": LIMIT_MS,
    "silenceMs": LIMIT_MS,
}
"""Time limits of programs that only a fault reaches; see web/shared/limits.js."""
SET_LIMITS = """async (limits) => {
    const scripts = [...document.scripts].map((each) => each.src);
    const own = scripts.filter((each) => each.endsWith("/main.js"));
    // modules that a test imports have another address than those of the page itself
    for (const base of [new URL("./web/page/main.js", document.baseURI), ...own]) {
        const module = await import(new URL("../shared/limits.js", base));
        Object.assign(module.limits, limits);
    }
}"""
WORLD_WAITS = (
    *("--grace", str(LIMIT_S)),
    *("--receive-timeout", str(round(LIMIT_MS))),
    *("--on-missing", "stop"),
)
"""Options of ``ai4u-edu play`` for a world that waits for programs, however late they are.

Without its program a robot stands still, or it would be elsewhere by the next decision.
"""


def set_limits(page: Page, **limits: float) -> None:
    """Change the time limits of programs in a page, until it is loaded again.

    Args:
        limits: those to change; the others become such that only a fault reaches them.
    """
    page.evaluate(SET_LIMITS, PATIENT | limits)


def code_page(chromium: Browser, url: str) -> Page:
    """Return a room's page, with the modules in ``window``, and no time limits."""
    page = new_page(chromium)
    WITHOUT_VISER.serve(page, url)
    page.goto(url)
    page.evaluate(
        """async () => {
            Object.assign(window, await import("./web/code/engine.js"));
            Object.assign(window, await import("./web/remote/client.js"));
            Object.assign(window, await import("./web/shared/limits.js"));
            window.engine = new CodeEngine();
        }"""
    )
    set_limits(page)
    return page


def use_stand_in(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let servers of this process give out the stand-in in place of the program package."""
    package = folder / "program"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "host.py").write_text(HOST)
    monkeypatch.setattr(web_files, "_PROGRAM", package)
    web_files._program.cache_clear()


def load(page: Page, source: str) -> dict[str, Any]:
    """Load a program, and return the engine's answer."""
    found: dict[str, Any] = page.evaluate(
        "([source, room]) => engine.load(source, room)", [source, ROOM]
    )
    return found


def decide(page: Page, percept: str = "{reading: 1}") -> dict[str, Any]:
    """Ask for a decision, and return the engine's answer.

    Args:
        percept: an expression of JavaScript.
    """
    text = page.evaluate(f"engine.decide({percept}, 1).then((answer) => JSON.stringify(answer))")
    found: dict[str, Any] = json.loads(text)
    return found


def run(page: Page, body: str) -> dict[str, Any]:
    """Load ``def decide(percept)`` with a body in one line, and return its first decision."""
    load(page, f"def decide(percept):\n    {body}")
    return decide(page)
