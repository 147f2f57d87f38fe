"""Scripts that speak JSON: the same world, the same refusals."""

import json
from typing import Any, Self

import pytest
from websockets.exceptions import ConnectionClosed

from ai4u_edu.page.server.scripts.sockets import MAX_MALFORMED_FRAMES
from ai4u_edu.wire import native
from tests.page.server.rooms import Room, open_socket
from tests.remote.rooms import SECRET, Script, connect, log_of, log_room
from tests.waiting import LIMIT_S


class JsonScript:
    """A script that says and hears one object at a time."""

    def __init__(self, room: Room, form: str = "json") -> None:
        names: Any = [native.SUBPROTOCOL]
        self.socket = open_socket(f"{room.url}ws/remote?format={form}", subprotocols=names)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.socket.close()

    def say(self, kind: str, **fields: Any) -> None:
        self.socket.send(json.dumps({"type": kind, **fields}))

    def hear(self) -> dict[str, Any]:
        message = self.socket.recv(LIMIT_S)
        assert isinstance(message, str)
        return dict(json.loads(message))

    def hello(self, **changes: Any) -> dict[str, Any]:
        fields = {"version": 1, "agent": "a", "token": "", "mode": "lockstep", "keys": []}
        self.say("hello", **(fields | {"session": "", "secret": SECRET} | changes))
        return self.hear()

    def act(self, percept: dict[str, Any], *numbers: Any) -> None:
        answered = {name: percept[name] for name in ("episode", "step", "seq")}
        self.say("action", **answered, values={"log": numbers})


def test_a_script_drives_by_json() -> None:
    with log_room(max_steps=3) as room, JsonScript(room) as script:
        welcome = script.hello()
        assert (welcome["type"], welcome["agent"], welcome["title"]) == ("welcome", "a", "A room")
        assert [each["key"] for each in welcome["readings"]] == ["place", "done", "id"]
        script.say("reset", seq=script.hear()["seq"], seed=None)
        percept = script.hear()
        for number in (1, 2, 3):
            assert percept["readings"]["place"] == [percept["episode"], percept["step"]]
            assert percept["readings"]["id"] == "a"
            assert percept["readings"]["done"] is False
            script.act(percept, number)
            percept = script.hear()
        assert (percept["truncated"], percept["terms"]) == (True, {"pay": 1.0})
        script.say("reset", seq=percept["seq"], seed=None)
        assert script.hear()["step"] == 0
        assert [number for _, _, number in log_of(room)] == [1.0, 2.0, 3.0]
        script.say("bye", reason="done")
        with pytest.raises(ConnectionClosed):
            script.hear()


def test_a_session_may_change_its_form() -> None:
    with log_room() as room:
        with JsonScript(room) as first:
            welcome = first.hello()
            percept = first.hear()
        with Script(room) as second:
            assert isinstance(second.hello(session=welcome["session"]), native.Welcome)
            assert second.percept().seq == percept["seq"]


def test_problems_are_sent_as_json() -> None:
    with log_room() as room, JsonScript(room) as script:
        script.hello()
        percept = script.hear()
        script.act(percept, None)
        problem = script.hear()
        assert (problem["type"], problem["code"]) == ("problem", "bad_message")
        assert problem["text"] == (
            "values: 'log': expected finite numbers, got null; JSON has no NaN and no infinity"
        )
        script.act(percept, 1, 2)
        assert script.hear()["text"] == "action 'log': expected 1 numbers, got 2: (1.0, 2.0)"
        script.act(percept, 7)
        script.hear()
        assert [number for _, _, number in log_of(room)] == [7.0]
        for _ in range(MAX_MALFORMED_FRAMES):
            script.socket.send("[")
        for _ in range(MAX_MALFORMED_FRAMES):
            problem = script.hear()
        assert problem["code"] == "malformed"


def test_an_unknown_form_is_refused() -> None:
    with log_room() as room, Script(room, query="?format=xml") as script:
        problem = script.hear()
        assert isinstance(problem, native.Problem)
        assert problem.text == "format: expected msgpack or json, got 'xml'"
        assert script.end()[0] == native.PROBLEMS["malformed"]


def test_both_forms_see_the_same_world() -> None:
    with log_room(2) as room, JsonScript(room) as script, connect(room.url, "b") as robot:
        script.hello(mode="realtime")
        there, here = script.hear(), robot.sense()
        assert there["readings"].keys() == set(here)
