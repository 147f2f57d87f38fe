"""Python in a worker of the page: it decides, it is ended if it does not, and it can do no harm."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu.page.server import web_files
from tests.browser.code_page import (
    ROOM,
    code_page,
    decide,
    load,
    run,
    set_limits,
    use_stand_in,
)
from tests.chromium import until_on
from tests.page.server.rooms import Room, served
from tests.waiting import LIMIT_MS

pytestmark = pytest.mark.browser

FORBIDDEN = [
    *("fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "WebTransport", "EventSource"),
    *("Worker", "SharedWorker", "importScripts", "BroadcastChannel", "postMessage", "close"),
    *("indexedDB", "caches", "cookieStore", "Notification", "FileReaderSync", "RTCPeerConnection"),
    *("storage", "localStorage", "StorageManager", "createImageBitmap", "OffscreenCanvas"),
]

CALL_MS = 2000
"""Time after which a page ends a program that does not come back; the product's own limit."""


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    with pytest.MonkeyPatch.context() as monkeypatch, served() as room:
        use_stand_in(tmp_path_factory.mktemp("stand-in"), monkeypatch)
        yield room
    web_files._program.cache_clear()


@pytest.fixture(scope="module")
def page(chromium: Browser, room: Room) -> Iterator[Page]:
    page = code_page(chromium, room.url)
    page.evaluate("engine.warm()")
    yield page
    page.context.close()


def test_a_program_decides(page: Page) -> None:
    answer = run(page, "return {'move': [percept['reading'] / 3, -0.0]}")
    assert answer["ok"]
    assert answer["values"] == {"move": [1 / 3, 0]}


def test_numbers_that_json_lacks_reach_the_program(page: Page) -> None:
    load(page, "def decide(percept):\n    return {}")
    said = decide(page, "{reading: [0.1, -0, Infinity, -Infinity, NaN, [true, 'text']]}")["said"]
    assert said == {
        "percept": {"reading": [0.1, "-0", "inf", "-inf", "nan", [True, "text"]]},
        "decision": 1,
    }


def test_only_a_loaded_program_is_asked(page: Page) -> None:
    page.evaluate("window.other = new CodeEngine()")
    answer = page.evaluate("other.begin()")
    assert (answer["ok"], answer["kind"]) == (False, "not_loaded")


@pytest.mark.parametrize(
    "body",
    [
        "10**10**8",  # in which Python looks at no signal
        pytest.param("while True: pass", marks=pytest.mark.nightly),
        pytest.param("sum(range(10**12))", marks=pytest.mark.nightly),
    ],
)
def test_a_program_that_never_comes_back_is_ended_and_the_page_goes_on(
    page: Page, body: str
) -> None:
    load(page, f"def decide(percept):\n    {body}")
    # a timer that is due before the engine's own limit: it fires first, if the page is not stuck
    page.evaluate("(() => { window.beats = 0; window.beat = setInterval(() => beats++, 50); })()")
    set_limits(page, callMs=CALL_MS)
    answer = decide(page)
    set_limits(page)
    assert (answer["ok"], answer["kind"]) == (False, "endless")
    assert "endless" in answer["text"]
    assert page.evaluate("clearInterval(beat), beats") > 0
    assert decide(page)["kind"] == "not_loaded"
    assert run(page, "return {'move': [1, 1]}")["values"] == {"move": [1, 1]}


@pytest.mark.nightly
def test_a_program_that_is_loaded_while_another_is_stuck_runs_after_it(page: Page) -> None:
    load(page, "def decide(percept):\n    10**10**8")
    page.evaluate(
        """([limit, patient]) => {
            limits.callMs = limit;
            // the next program has the time that it needs
            const after = () => (limits.callMs = patient);
            window.stuck = engine.decide({}, 1).finally(after);
        }""",
        [CALL_MS, LIMIT_MS],
    )
    assert run(page, "return {'move': [1, 0]}")["values"] == {"move": [1, 0]}
    assert page.evaluate("stuck")["kind"] == "endless"


def test_of_a_stopped_program_no_answer_comes_later_and_no_file_is_left(page: Page) -> None:
    assert run(page, "open('/home/pyodide/kept', 'w').write('x'); return {}")["ok"]
    load(page, "def decide(percept):\n    while True: pass")
    page.evaluate("void (window.answer = engine.decide({}, 1))")
    page.evaluate("engine.end()")
    assert page.evaluate("answer")["kind"] == "ended"
    assert "FileNotFoundError" in run(page, "open('/home/pyodide/kept')")["text"]
    assert run(page, "return {}")["ok"]


@pytest.mark.parametrize(
    "method",
    [
        pytest.param("", id="while-files-are-fetched"),
        pytest.param("start", id="while-python-starts"),
        pytest.param("load", id="while-the-program-is-loaded"),
    ],
)
def test_who_waits_for_an_engine_that_is_ended_is_told(page: Page, method: str) -> None:
    answer = page.evaluate(
        """async ([method, room]) => {
            const other = new CodeEngine();
            const { postMessage } = Worker.prototype;
            Worker.prototype.postMessage = function (message) {
                postMessage.call(this, message);
                if (message.method === method) other.end();
            };
            const loaded = other.load("", room);
            await null; // it makes its worker
            if (!method) other.end();
            return loaded.finally(() => (Worker.prototype.postMessage = postMessage));
        }""",
        [method, ROOM],
    )
    assert answer["ok"] is False


def test_an_answer_has_a_limited_size(page: Page) -> None:
    answer = run(page, "return 'x' * 2 * 10**6")
    assert (answer["ok"], answer["kind"]) == (False, "too_large")
    assert run(page, "print('x' * 10**7); return {}")["ok"]


def test_many_programs_run_one_after_another(page: Page) -> None:
    workers = len(page.workers)
    for number in range(5):
        assert run(page, f"return {number}")["values"] == number
    until_on(page, lambda: len(page.workers) <= workers + 1)  # Chromium ends them a bit later


TICKS = """
import asyncio, sys, math
def tick():
    loop.call_later(0, tick)
def decide(percept):
    global loop
    loop = asyncio.get_event_loop()
    tick()
    open("/tmp/kept", "w").write("x")
    math.kept = sys.kept = True
    return {}
"""
"""A program that goes on computing, and leaves something in modules and in a file."""
LOOKS = """
import math, os, sys
def decide(percept):
    return [os.path.exists("/tmp/kept"), hasattr(math, "kept"), hasattr(sys, "kept")]
"""


@pytest.mark.parametrize("way", ["finish", "load"])
def test_nothing_of_a_program_is_left_or_goes_on_after_it(page: Page, way: str) -> None:
    page.evaluate("engine.end()")
    until_on(page, lambda: not page.workers)  # Chromium ends them a bit later
    assert load(page, TICKS)["ok"]
    worker = page.workers[0]  # there may be a spare one, too
    assert decide(page)["ok"]
    ended = []
    worker.on("close", lambda _: ended.append(True))
    if way == "finish":
        page.evaluate("engine.finish()")
        assert decide(page)["kind"] == "not_loaded"
    assert load(page, LOOKS)["ok"]
    assert decide(page)["values"] == [False, False, False]
    until_on(page, lambda: bool(ended))


def test_a_program_whose_run_has_ended_meanwhile_is_not_loaded(page: Page) -> None:
    load(page, "def decide(percept):\n    return {}")
    answer = page.evaluate(
        """async (room) => {
            const loaded = engine.load("", room);
            engine.finish();
            return loaded;
        }""",
        ROOM,
    )
    assert (answer["ok"], answer["kind"]) == (False, "ended")
    assert run(page, "return 1")["values"] == 1


@pytest.mark.parametrize(
    "body",
    [
        "import js",
        "import pyodide_js",
        "from pyodide.code import run_js; run_js('1')",
        "import pyodide.http; pyodide.http.open_url('healthz')",
        "import urllib.request; urllib.request.urlopen('http://127.0.0.1:1/')",
        "import socket; socket.create_connection(('127.0.0.1', 80), 1)",
        "import subprocess; subprocess.run(['ls'])",
        "import asyncio; asyncio.run(__import__('pyodide').http.pyfetch('healthz'))",
    ],
)
def test_python_reaches_neither_page_nor_network(page: Page, body: str) -> None:
    answer = run(page, body)
    assert not answer["ok"]
    assert "Error" in answer["text"]


def test_nothing_is_left_to_the_worker_that_connects_or_stores(page: Page) -> None:
    page.evaluate("engine.end()")
    until_on(page, lambda: not page.workers)  # Chromium ends them a bit later
    assert run(page, "return {}")["ok"]
    worker = page.workers[0]  # there may be a spare one, too
    found = worker.evaluate("(names) => names.filter((name) => name in self)", FORBIDDEN)
    assert found == []
    assert worker.evaluate("Object.keys(navigator)") == ["userAgent", "language"]
    hidden = "Object.getOwnPropertyDescriptor(WorkerGlobalScope.prototype, 'navigator')"
    assert worker.evaluate(f"self.WorkerGlobalScope === undefined || {hidden} === undefined")


def test_the_policy_forbids_the_worker_what_it_still_has(page: Page) -> None:
    page.evaluate(
        """() => {
            const url = new URL("web/code/worker.js?bare", location);
            window.bare = new Worker(url, { type: "module" });
            // it has no program, and says so
            return new Promise((answered) => {
                bare.onmessage = () => answered();
                bare.postMessage({ id: 1, method: "begin", text: "" });
            });
        }"""
    )
    (worker,) = (each for each in page.workers if each.url.endswith("?bare"))
    refused = worker.evaluate(
        """async () => {
            const attempts = {
                fetch: () => fetch(new URL("../healthz", location)),
                socket: () => new Promise((resolve, reject) => {
                    const socket = new WebSocket(new URL("../ws/input", location));
                    [socket.onopen, socket.onerror] = [resolve, reject];
                }),
                worker: () => new Promise((resolve, reject) => {
                    const worker = new Worker(location, { type: "module" });
                    worker.onerror = reject;
                    worker.onmessage = resolve;
                    worker.postMessage({ id: 1, method: "begin", text: "" });
                }),
                data: () => import("data:text/javascript,1"),
                text: () => new Function("1"),
                scripts: () => importScripts("../page/main.js"),
            };
            const refused = [];
            for (const [name, attempt] of Object.entries(attempts)) {
                try { await attempt(); } catch { refused.push(name); }
            }
            return refused;
        }"""
    )
    page.evaluate("bare.terminate()")
    assert refused == ["fetch", "socket", "worker", "data", "text", "scripts"]


def test_a_server_that_is_gone_is_told_and_asked_again(page: Page, room: Room) -> None:
    other = page.context.new_page()
    other.goto(f"{room.url}healthz")
    other.route("**/program.zip", lambda route: route.abort())
    load_it = "(room) => engine.load('def decide(percept): return {}', room)"
    other.evaluate("import('./web/code/engine.js').then((each) => Object.assign(window, each))")
    other.evaluate("void (window.engine = new CodeEngine())")
    answer = other.evaluate(load_it, ROOM)
    assert (answer["ok"], answer["kind"]) == (False, "unavailable")
    assert "could not be loaded" in answer["text"]
    other.unroute("**/program.zip")
    assert other.evaluate(load_it, ROOM)["ok"]
    other.close()
