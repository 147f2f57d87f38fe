"""The API says what its own description says."""

import json
import math
import threading
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import BasicAgent, MinDistReward, RayCastingSensor, Sensor, WASDRBMoveController
from ai4u_edu.base.version import __version__
from ai4u_edu.page.server.api import SnapshotView, finite
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.training_progress import CurvePoint, TrainingProgress
from tests.builders import small_sim
from tests.json_schema import validator_of
from tests.page.server import http_client
from tests.page.server.rooms import Room, served
from tests.remote.rooms import connect, patient_rules
from tests.waiting import LIMIT_S, until

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator


@pytest.fixture
def room() -> Iterator[Room]:
    sim = small_sim(
        [RayCastingSensor(perception_key="eyes", rows=2, columns=3, group_code={"target": 2})],
        controller=WASDRBMoveController(),
        rewards=[MinDistReward(target="box")],
    )
    with served(sim, title="Box <chase>") as room:
        yield room


def checker(document: dict[str, Any], schema: dict[str, Any]) -> "Draft202012Validator":
    """Return a validator of one schema of a document."""
    return validator_of({"components": document["components"], **schema})


def get(room: Room, path: str) -> Any:
    answer = http_client.get(room.url + path)
    assert answer.status_code == 200
    assert answer.headers["Content-Type"] == "application/json"
    return json.loads(answer.text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


@pytest.mark.parametrize("path", ["healthz", "api/snapshot", "api/past", "api/training"])
def test_an_answer_fits_its_description(room: Room, path: str) -> None:
    document = get(room, "api/openapi.json")
    described = document["paths"]["/" + path]["get"]["responses"]["200"]["content"]
    checker(document, described["application/json"]["schema"]).validate(get(room, path))


def test_the_check_would_notice_a_misfit(room: Room) -> None:
    check = checker(get(room, "api/openapi.json"), {"$ref": "#/components/schemas/SnapshotView"})
    seen = get(room, "api/snapshot")
    for name, wrong in [("tick", "3"), ("paused", 1), ("agents", [{}]), ("time", []), ("x", 1)]:
        assert not check.is_valid(seen | {name: wrong})
    assert not check.is_valid({})


def test_the_description_is_complete(room: Room) -> None:
    document = get(room, "api/openapi.json")
    assert document["openapi"] == "3.1.0"
    assert document["info"]["version"] == __version__
    assert set(document["paths"]) == {
        "/healthz",
        "/api/snapshot",
        "/api/training",
        "/api/past",
        "/api/past/{file}",
        "/api/openapi.json",
    }
    for path in document["paths"]:
        if "{" not in path:
            get(room, path[1:])
    assert "$defs" not in json.dumps(document)


def test_a_training_tells_its_progress(room: Room) -> None:
    assert get(room, "api/training") == {"training": None}
    point = CurvePoint(decisions=500, reward=-0.5, success=None)
    room.runner.training = TrainingProgress(
        decisions=700, total=1000, is_over=False, curve=(point,)
    )
    test_an_answer_fits_its_description(room, "api/training")
    assert get(room, "api/training")["training"] == {
        "decisions": 700,
        "total": 1000,
        "is_over": False,
        "curve": [{"decisions": 500, "reward": -0.5, "success": None}],
        "easy_starts": None,
    }
    room.runner.training = None


def test_a_snapshot_tells_what_the_world_is_like(room: Room) -> None:
    with room.page() as page:
        page.hold("KeyW")
        until(lambda: get(room, "api/snapshot")["agents"][0]["action"].get("move", [0])[0] == 1)
    room.runner.pause().result(LIMIT_S)
    seen, latest = get(room, "api/snapshot"), room.runner.latest
    assert (seen["tick"], seen["episode"], seen["seed"]) == (latest.tick, latest.episode, 1)
    assert seen["paused"] is True
    agent, state = seen["agents"][0], latest.agents[0]
    body = next(body for body in latest.bodies if body.name == "robot")
    assert agent["pose"] == [body.x, body.y, body.z, body.heading]
    assert agent["velocity"] == [body.vx, body.vy, body.vz]
    assert np.array_equal(agent["percept"]["eyes"], state.percept["eyes"])
    assert agent["reward_terms"] == state.reward_terms
    assert agent["episode_terms"] == state.episode_terms
    assert agent["steps"] == state.steps
    assert {each["name"] for each in seen["bodies"]} == {"robot", "box"}


def test_health_follows_the_world(room: Room) -> None:
    health = get(room, "healthz")
    assert health == {
        "status": "ok",
        "version": __version__,
        "waiting": "",
        "scene": "Box <chase>",
        "uptime": health["uptime"],
        "block": "",
        "since": None,
    }
    assert health["uptime"] >= 0
    room.runner.pause().result(LIMIT_S)
    assert get(room, "healthz")["status"] == "paused"

    def broken(_: BasicAgent) -> None:
        raise RuntimeError("odd")

    room.sim.agents[0].end_of_step.connect(broken)
    room.runner.step().result(LIMIT_S)
    assert get(room, "healthz")["status"] == "error"
    told = "RuntimeError: odd (while handler broken of end_of_step of agent '0' was called)"
    assert get(room, "api/snapshot")["error"] == told


class Slow(Sensor):
    """Takes a while, or for ever."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.may_answer = threading.Event()
        self.may_answer.set()
        self.is_asked = threading.Event()
        """Set once it is asked while it may not answer."""

    def space(self) -> Box:
        return Box(0.0, 1.0, (1,))

    def read(self, body: Any, view: Any) -> list[float]:
        if not self.may_answer.is_set():
            self.is_asked.set()
            self.may_answer.wait()
        return [0.0]


def test_health_tells_which_block_does_not_return() -> None:
    sensor = Slow()
    began = datetime.now(UTC).replace(microsecond=0)
    with served(small_sim([sensor]), stall_s=0.0) as room:
        try:
            sensor.may_answer.clear()
            assert sensor.is_asked.wait(LIMIT_S)
            answer = http_client.get(room.url + "healthz")
            document = http_client.get(room.url + "api/openapi.json").json()
        finally:
            sensor.may_answer.set()
    assert answer.status_code == 503
    health = answer.json()
    assert health["status"] == "stalled"
    assert health["block"].startswith("Sensor Slow 'slow' of agent '0' (test_api.py, line ")
    described = document["paths"]["/healthz"]["get"]["responses"]["503"]["content"]
    checker(document, described["application/json"]["schema"]).validate(health)
    assert began <= datetime.fromisoformat(health["since"]) <= datetime.now(UTC)


def test_a_block_that_sleeps_keeps_nobody_but_the_world_waiting() -> None:
    sensor = Slow()
    with served(small_sim([sensor]), rules=patient_rules()) as room:
        room.runner.scale_time(math.inf).result(LIMIT_S)
        with connect(room.url, mode="lockstep") as robot:
            robot.sense()
            sensor.may_answer.clear()
            robot.act(move=[0, 0, 0, 0])
            try:
                assert sensor.is_asked.wait(LIMIT_S)  # the script's answer has the world tick
                assert http_client.get(room.url + "healthz").status_code in (200, 503)
                assert not sensor.may_answer.is_set()
            finally:
                sensor.may_answer.set()
            robot.sense()


def test_nonfinite_numbers_become_null_in_json() -> None:
    runner = Runner(small_sim(rewards=[MinDistReward(target="box")]), time_scale=math.inf)
    seen = json.loads(SnapshotView.of(runner.latest).model_dump_json())
    assert seen["time_scale"] is None
    assert [finite(each) for each in (math.inf, -math.inf, math.nan, 0.5)] == [None] * 3 + [0.5]


def test_the_api_only_looks(room: Room) -> None:
    for path in ("healthz", "api/snapshot", "api/past", "api/training", "api/openapi.json", ""):
        assert http_client.post(room.url + path).status_code == 405
