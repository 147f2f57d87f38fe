"""A student's program, with the package that runs it, drives an agent in rooms of each kind."""

import gzip
import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu.page.server.web_files import web_folder
from tests.browser.code_page import (
    ROOM,
    WORLD_WAITS,
    code_page,
    decide,
    load,
    run,
    set_limits,
)
from tests.chromium import new_page
from tests.classroom.served_class import served_class
from tests.page.server.rooms import served
from tests.playing import played
from tests.waiting import LIMIT_MS

pytestmark = pytest.mark.browser

TOKEN = "open sesame"
CALL_MS = 10_000
"""Time after which the page ends a program: the lines that run until then have been reported."""
PROGRAM = """
def decide(percept):
    for key in percept:
        print(key, percept[key])
    return {"move": [1.0, 0.25, 0, 0]}
"""
FROM_SOURCE = """
import sys

specs = [getattr(each, "__spec__", None) for each in sys.modules.values()]
files = [each.origin for each in specs if each and ".zip/" in (each.origin or "")]
source = [each for each in files if not each.endswith(".pyc") and "ai4u" not in each]

def decide(percept):
    print(len(files), source)
    return {"move": [0, 0]}
"""
"""Prints the number of modules that are there, and which were compiled from source."""
DRIVE = """
    async (source) => {
        for (const name of ["code/engine", "remote/client"]) {
            Object.assign(window, await import(`./web/${name}.js`));
        }
        const client = await RemoteClient.connect({ mode: "lockstep" });
        const engine = new CodeEngine();
        const { outputs, welcome: { readings } } = client;
        const loaded = await engine.load(source, { outputs, readings });
        if (!loaded.ok) return JSON.stringify([loaded]);
        await client.reset();
        await engine.begin();
        const answers = [];
        for (let number = 1; number <= 20; number += 1) {
            const { values, terminated, step } = await client.sense();
            if (terminated) break;
            answers.push({ ...(await engine.decide(values, number)), step });
            await client.act(answers.at(-1).values);
        }
        await client.close();
        engine.end();
        return JSON.stringify(answers);
    }
"""


@pytest.fixture(scope="module")
def page(chromium: Browser) -> Iterator[Page]:
    with served() as room:
        page = code_page(chromium, room.url)
        page.evaluate("engine.warm()")
        yield page
        page.context.close()


def driven(page: Page) -> list[dict[str, Any]]:
    """Let the program drive the agent of the page's room, and return its decisions."""
    set_limits(page)
    found: list[dict[str, Any]] = json.loads(page.evaluate(DRIVE, PROGRAM))
    assert len(found) > 5
    return found


def steps(decisions: list[dict[str, Any]]) -> list[int]:
    return [each["step"] for each in decisions]


def test_readings_have_the_types_that_they_have_outside(page: Page) -> None:
    answer = run(page, "print(percept['reading']); return {'move': [percept['reading'] / 3, 0]}")
    assert (answer["ok"], answer["printed"]) == (True, "1.0\n")
    load(
        page,
        "def decide(percept):\n    print(list(percept['reading']))\n    return {'move': [0,0]}",
    )
    answer = decide(page, "{reading: [1, -0, Infinity, -Infinity, NaN]}")
    assert answer["printed"] == "[1.0, -0.0, inf, -inf, nan]\n"


def test_what_python_imports_at_its_start_is_compiled(page: Page) -> None:
    load(page, FROM_SOURCE)
    count, _, source = decide(page)["printed"].partition(" ")
    assert int(count) > 100
    assert source == "[]\n"


@pytest.mark.parametrize(
    ("body", "line", "kind"),
    [
        ("import js", 2, "import"),
        ("import numpy", 2, "numpy"),
        ("return percept['raeding']", 2, "wrong-key"),
        ("return 'x' * 10**7", 2, "action"),
    ],
)
def test_mistakes_have_a_kind_and_a_line(page: Page, body: str, line: int, kind: str) -> None:
    answer = load(page, f"def decide(percept):\n    {body}")
    if answer["ok"]:
        answer = decide(page)
    assert (answer["ok"], answer["line"], answer["kind"]) == (False, line, kind)


def test_a_huge_print_is_cut(page: Page) -> None:
    answer = run(page, "print('x' * 10**7); return {'move': [0, 0]}")
    assert answer["ok"]
    assert 1000 < len(answer["printed"]) < 5000


@pytest.mark.nightly  # the engine's own tests end programs each time
@pytest.mark.parametrize(
    ("body", "limits"),
    [
        ("while True: pass", {"programS": 1}),
        ("10**10**8", {"callMs": CALL_MS}),
        ("sum(range(10**12))", {"callMs": CALL_MS}),
    ],
)
def test_a_program_that_does_not_come_back_is_ended_at_its_line(
    page: Page, body: str, limits: dict[str, float]
) -> None:
    set_limits(page, **limits)
    answer = run(page, body)
    set_limits(page)
    assert (answer["ok"], answer["line"], answer["kind"]) == (False, 2, "endless")


def test_the_time_of_a_decision_is_limited_as_the_page_says(page: Page) -> None:
    slow = "import time; end = time.monotonic() + 0.2\n    while time.monotonic() < end: pass"
    set_limits(page, programS=0.1)
    assert run(page, f"{slow}\n    return {{}}")["kind"] == "endless"
    set_limits(page)
    assert run(page, f"{slow}\n    return {{}}")["ok"]


@pytest.mark.nightly
def test_loading_may_be_endless_too(page: Page) -> None:
    set_limits(page, callMs=CALL_MS)
    answer = load(page, "y = 0\nx = 10**10**8\n")
    set_limits(page)
    assert (answer["kind"], answer["line"]) == ("endless", 2)
    assert page.evaluate("(room) => engine.load('def decide(percept): return {}', room)", ROOM)[
        "ok"
    ]


@pytest.mark.nightly
@pytest.mark.slow
def test_behind_a_token(chromium: Browser) -> None:
    with played("box_chase", "--token", TOKEN, *WORLD_WAITS) as game:
        page = new_page(chromium)
        page.goto(game.url.rstrip("/"))  # which has the token
        decisions = driven(page)
        assert decisions[0]["values"] == {"move": [1.0, 0.25, 0, 0]}
        assert steps(decisions) == list(range(len(decisions)))
        page.context.close()


@pytest.mark.slow
def test_in_a_class(chromium: Browser, tmp_path_factory: pytest.TempPathFactory) -> None:
    patient = ("--receive-timeout", str(round(LIMIT_MS)))
    with served_class(tmp_path_factory.mktemp("class"), *patient) as school:
        ada = school.joined()
        page = new_page(chromium)
        cookies = [
            {"name": n, "value": v, "url": school.url} for n, v in ada.client.cookies.items()
        ]
        page.context.add_cookies(cookies)  # type: ignore[arg-type]  # a TypedDict of playwright
        page.goto(f"{school.url}{ada.room.lstrip('/')}healthz")
        decisions = driven(page)
        assert decisions[0]["values"] == {"move": [1.0, 0.25, 0, 0]}
        assert steps(decisions) == list(range(len(decisions)))
        page.context.close()
        name = "web/vendor/pyodide/pyodide.asm.wasm"
        answer = ada.get(f"{name}?v=1")
        packed = (web_folder().parent / f"{name}.gz").read_bytes()
        assert answer.content == gzip.decompress(packed)
        assert answer.headers["Content-Length"] == str(len(packed))
        assert "immutable" in answer.headers["Cache-Control"]
        policy = ada.get("web/code/worker.js").headers["Content-Security-Policy"]
        assert policy.startswith("default-src 'none';")
