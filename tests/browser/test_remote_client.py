"""The page drives an agent over the protocol for scripts, as scripts elsewhere do."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu import Scene
from ai4u_edu.page.server import Rules
from ai4u_edu.remote import connect
from ai4u_edu.wire import native
from tests.browser.code_page import code_page, set_limits
from tests.chromium import new_page
from tests.page.server.rooms import Room, served
from tests.waiting import LIMIT_MS, LIMIT_S

pytestmark = pytest.mark.browser

SEED, DECISIONS = 7, 60
KEEP_SOCKETS = """
    () => {
        window.sockets = [];
        window.WebSocket = class extends WebSocket {
            constructor(...given) {
                super(...given);
                if (String(given[0]).endsWith("ws/remote")) window.sockets.push(this);
            }
        };
    }
"""
DRIVE = """
    async ([seed, actions]) => {
        window.client = await RemoteClient.connect({ mode: "lockstep" });
        const seen = [await client.reset(seed)];
        for (const move of actions) {
            await client.act({ move });
            seen.push(await client.sense());
            if (seen.at(-1).terminated) break;
        }
        return JSON.stringify(seen);
    }
"""

PATIENT_RULES = Rules(grace=LIMIT_S, receive_timeout=round(LIMIT_MS))


@contextmanager
def chase(**options: Any) -> Iterator[Room]:
    """Serve the scene box_chase, fifty times as fast.

    It waits for programs, however late they are.
    """
    sim = Scene.load("box_chase").build(seed=1)
    with served(sim, **({"rules": PATIENT_RULES} | options)) as room:
        room.runner.scale_time(50).result(LIMIT_S)
        yield room


@pytest.fixture
def room() -> Iterator[Room]:
    with chase() as room:
        yield room


@pytest.fixture
def page(chromium: Browser, room: Room) -> Iterator[Page]:
    page = code_page(chromium, room.url)
    page.evaluate(KEEP_SOCKETS)
    yield page
    page.evaluate("window.client?.close()")
    page.context.close()


def actions() -> list[list[float]]:
    return [[0.5 + number % 3 / 7, (number % 5 - 2) / 3, 0, 0] for number in range(DECISIONS)]


def plain(percept: Any) -> dict[str, Any]:
    """Return a percept of the Python client in the form of the page's."""
    values = {
        key: each.tolist() if hasattr(each, "tolist") else each for key, each in percept.items()
    }
    names = ("episode", "step", "seq", "tick", "reward", "terminated", "truncated")
    return {
        "values": values,
        "terms": percept.reward_terms,
        **{name: getattr(percept, name) for name in names},
    }


def test_the_page_knows_the_fields_of_all_messages(page: Page) -> None:
    found = page.evaluate(
        """import("./web/remote/messages.js").then(({ FIELDS, READING, OUTPUT, PROBLEMS }) => (
            { ...FIELDS, reading: READING, output: OUTPUT, problems: [...PROBLEMS] }
        ))"""
    )
    assert dict(found.pop("problems")) == {code: name for name, code in native.PROBLEMS.items()}
    kinds = (native.Welcome, native.Percept, native.Problem, native.Bye)
    known = {kind.__name__.lower(): kind.__struct_fields__ for kind in (*kinds, native.Reading)}
    known["output"] = native.Output.__struct_fields__
    assert found == {name: list(map(camel, fields)) for name, fields in known.items()}


def camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(map(str.capitalize, rest))


def test_in_lockstep_the_page_gets_the_bits_that_a_script_gets(page: Page) -> None:
    seen = json.loads(page.evaluate(DRIVE, [SEED, actions()]))
    expected = []
    with chase() as other, connect(other.url, mode="lockstep", patience=LIMIT_S) as robot:
        expected.append(plain(robot.reset(SEED)))
        for move in actions():
            robot.act(move=move)
            expected.append(plain(robot.sense()))
            if expected[-1]["terminated"]:
                break
    assert len(expected) > 10
    kept = expected[0].keys()
    assert [{key: each[key] for key in kept} for each in seen] == expected


def test_in_realtime_the_world_goes_on_with_what_it_has(page: Page, room: Room) -> None:
    room.runner.scale_time(1).result(
        LIMIT_S
    )  # fifty times as fast, the episode may be over too soon
    page.evaluate("RemoteClient.connect().then((each) => void (window.client = each))")
    assert page.evaluate("client.welcome.mode") == "realtime"
    assert page.evaluate("client.outputs.move") == [[-1, -1, 0, 0], [1, 1, 1, 1]]
    first = page.evaluate("client.reset(1)")
    page.evaluate("client.act({ move: [1, 0, 0, 0] })")
    second = page.evaluate("client.sense()")
    assert second["seq"] > first["seq"]
    assert set(second["values"]) == set(page.evaluate("client.welcome.readings.map((r) => r.key)"))


def test_a_dropped_connection_is_taken_up_again(page: Page) -> None:
    page.evaluate(
        "RemoteClient.connect({ mode: 'lockstep' }).then((each) => void (window.client = each))"
    )
    before = page.evaluate("client.reset()")
    for _ in range(3):
        page.evaluate("sockets.at(-1).close()")
        page.evaluate("client.act({ move: [1, 0, 0, 0] })")
        page.evaluate("sockets.at(-1).close()")
        after = page.evaluate("client.sense()")
        assert (after["episode"], after["step"]) == (before["episode"], before["step"] + 1)
        before = after
    assert page.evaluate("sockets.length") > 3


def test_a_world_that_is_gone_is_told(chromium: Browser) -> None:
    # real time: the world is gone for good, and the page tries again for as long
    with chase(rules=Rules(grace=0.5)) as room:
        page = code_page(chromium, room.url)
        page.evaluate("RemoteClient.connect().then((each) => void (window.client = each))")
        page.evaluate("client.sense()")
    page.evaluate("client.act({ move: [1, 0, 0, 0] }).catch(() => {})")
    # a world that did not wait for the page may have sent a percept before it was gone
    error = told(page, "client.sense()") or told(page, "client.sense()")
    assert error["code"] in ("lost", "ended")
    assert told(page, "client.sense()") == error
    page.context.close()


def told(page: Page, expression: str) -> dict[str, str]:
    """Return code and message of the error that an expression rejects with."""
    found: dict[str, str] = page.evaluate(
        f"{expression}.then(() => ({{}}), ({{ code, message }}) => ({{ code, message }}))"
    )
    return found


def test_an_agent_that_a_script_drives_is_not_given_to_the_page(page: Page, room: Room) -> None:
    with connect(room.url, patience=LIMIT_S):
        error = told(page, "RemoteClient.connect()")
    assert error["code"] == "agent_taken"
    assert "is driven by another script" in error["message"]
    page.evaluate("RemoteClient.connect().then((each) => void (window.client = each))")
    error = told(page, "RemoteClient.connect({ agent: 'nobody' })")
    assert error["code"] == "unknown_agent"


def test_a_wrong_action_is_told_and_can_be_mended(page: Page) -> None:
    page.evaluate(
        "RemoteClient.connect({ mode: 'lockstep' }).then((each) => void (window.client = each))"
    )
    before = page.evaluate("client.reset()")
    page.evaluate("client.act({ mvoe: [1] })")
    error = told(page, "client.sense()")
    assert error["code"] == "bad_action"
    assert "mvoe" in error["message"]
    page.evaluate("client.act({ move: [1, 0, 0, 0] })")
    assert page.evaluate("client.sense()")["step"] == before["step"] + 1


def test_closing_gives_the_agent_back_at_once(page: Page, room: Room) -> None:
    room.runner.scale_time(1).result(LIMIT_S)  # see above
    for _ in range(3):
        page.evaluate("RemoteClient.connect().then((each) => void (window.client = each))")
        page.evaluate("client.reset(1)")
        page.evaluate("client.act({ move: [1, 0, 0, 0] })")
        page.evaluate("void (window.waiting = client.sense().catch(({ code }) => code))")
        page.evaluate("client.close()")
        assert page.evaluate("waiting") in ("closed", {}) or page.evaluate("waiting")["seq"]
        assert told(page, "client.sense()")["code"] == "closed"
    connect(room.url, patience=LIMIT_S).close()


def test_a_page_with_the_token_needs_no_other(chromium: Browser) -> None:
    with chase(rules=replace(PATIENT_RULES, token="open sesame")) as room:
        page = new_page(chromium)
        page.goto(f"{room.url}?token=open+sesame")
        set_limits(page)
        page.evaluate(
            "import('./web/remote/client.js').then((each) => Object.assign(window, each))"
        )
        page.evaluate("RemoteClient.connect().then((each) => void (window.client = each))")
        assert page.evaluate("client.sense()")["seq"] >= 1
        page.context.close()
