"""A room's scene is shared by a link, and opened from one."""

import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import httpx
import pytest

from ai4u_edu import Sensor
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.editing.sharing import read_shared, shared_link
from ai4u_edu.page.server import Rules, ServerThread, Timeouts, room_app
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene_link import encode_link
from tests.page.server import http_client
from tests.page.server.rooms import NOWHERE, PATIENT, served
from tests.page.server.test_api import checker
from tests.waiting import LIMIT_S

LINK = shared_link(Scene.load("maze"), 2**60 + 1).fragment


@dataclass
class Shared:
    """A served room with an editor."""

    runner: Runner
    editor: SceneEditor
    url: str

    def get(self, path: str) -> Any:
        return http_client.get(self.url + path).json()

    def post(self, path: str, **body: Any) -> httpx.Response:
        return http_client.post(self.url + path, json=body)


@pytest.fixture
def timeouts() -> Timeouts:
    return PATIENT


@pytest.fixture
def room(timeouts: Timeouts) -> Iterator[Shared]:
    scene = Scene.load("box_chase")
    runner = Runner(scene.build(), seed=2**60)
    editor = SceneEditor(runner, scene)
    app = room_app(
        runner,
        viser_port=NOWHERE,
        title=lambda: editor.title,
        editor=editor,
        timeouts=timeouts,
    )
    runner.start()
    try:
        with ServerThread(app, timeouts=timeouts) as server:
            yield Shared(runner, editor, server.url)
    finally:
        runner.stop(LIMIT_S)


def test_a_link_holds_the_present_scene_with_its_changes_and_seed(room: Shared) -> None:
    room.editor.change_settings({"title": "Lesson 1"}).result(LIMIT_S)
    assert room.get("api/scene") == {
        "name": "box_chase",
        "title": "Lesson 1",
        "is_changed": True,
        "is_autosaved": False,
    }
    made = room.get("api/scene/link")
    assert (made["title"], made["needs"]) == ("Lesson 1", [])
    shared = read_shared(made["fragment"])
    assert shared == (room.editor.scene, 2**60)


def test_a_link_is_described_without_opening_it(room: Shared) -> None:
    answer = room.post("api/scene/link", link=f"http://elsewhere/#{LINK}")
    assert answer.json() == {"name": "maze", "title": "Maze", "seed": 2**60 + 1}
    assert room.editor.version == 0


def test_a_scene_is_opened_from_a_link_and_undone(room: Shared) -> None:
    answer = room.post("api/scene", link=f"#{LINK}")
    assert (answer.status_code, answer.json()["title"]) == (200, "Maze")
    assert room.editor.title == "Maze"
    assert room.runner.latest.seed == 2**60 + 1
    assert not room.get("api/scene")["is_changed"]
    room.editor.undo().result(LIMIT_S)
    assert room.editor.state.description.name == "box_chase"


def test_a_scene_of_the_library_is_opened_by_its_name(room: Shared) -> None:
    assert room.post("api/scene", name="tag").json()["name"] == "tag"
    assert room.editor.state.description.name == "tag"
    for name in ("../library/tag", "/etc/passwd", "tag.yaml", "TAG"):
        answer = room.post("api/scene", name=name)
        assert (answer.status_code, "no scene is called" in answer.text) == (404, True)


def test_a_saved_scene_has_no_unsaved_changes(room: Shared) -> None:
    def is_changed() -> object:
        return room.get("api/scene")["is_changed"]

    room.editor.change_settings({"title": "Lesson 1"}).result(LIMIT_S)
    room.editor.recovery.mark_saved(room.editor.scene)
    assert not is_changed()
    room.editor.change_settings({"title": "Lesson 2"}).result(LIMIT_S)
    assert is_changed()
    room.editor.undo().result(LIMIT_S)
    assert not is_changed()


def test_saved_scenes_are_listed_and_opened(room: Shared, tmp_path: Path) -> None:
    assert room.get("api/scenes")["saved"] == []
    assert "no scenes are saved here" in room.post("api/scene", saved="Lesson 1").text
    room.editor.scene_store = SceneStore(tmp_path)
    room.editor.scene_store.save("Lesson 1", Scene.load("maze"))
    (saved,) = room.get("api/scenes")["saved"]
    assert (saved["name"], saved["title"]) == ("Lesson 1", "Lesson 1")
    assert saved["picture"].startswith("data:image/png;base64,")
    assert room.post("api/scene", saved="Lesson 1").json()["name"] == "maze"
    assert room.editor.title == "Maze"
    assert room.post("api/scene", saved="../maze").status_code == 422


@pytest.mark.parametrize("path", ["api/scene", "api/scene/link"])
@pytest.mark.parametrize(
    ("link", "said"),
    [
        (LINK[:60], "the link is damaged"),
        (encode_link("name: x\nagents: 3"), "the link, line 2: agents"),
        (encode_link("agents: [{host: evil.example}]"), "connect to 'evil.example'"),
        ("elsewhere", "expected #scene="),
    ],
)
def test_a_wrong_link_is_refused_with_a_sentence(
    room: Shared, path: str, link: str, said: str
) -> None:
    answer = room.post(path, link=link)
    assert (answer.status_code, said in answer.text) == (422, True), answer.text
    assert answer.headers["Content-Type"].startswith("text/plain")
    assert room.editor.version == 0


@pytest.mark.parametrize(
    ("options", "status"),
    [
        ({"json": {}}, 422),
        ({"json": {"link": LINK, "name": "maze"}}, 422),
        ({"json": {"link": 3}}, 422),
        ({"json": {"link": LINK, "code": "import os"}}, 422),
        ({"content": b"{", "headers": {"Content-Type": "application/json"}}, 422),
        ({"content": b"[" * 200_000, "headers": {"Content-Type": "application/json"}}, 422),
        ({"json": {"link": "x" * 300_000}}, 413),
        ({"data": {"link": LINK}}, 415),
        ({"content": LINK, "headers": {"Content-Type": "text/plain"}}, 415),
        ({"json": {"link": LINK}, "headers": {"Origin": "http://evil.example"}}, 403),
    ],
)
def test_another_body_is_refused(room: Shared, options: Any, status: int) -> None:
    answer = http_client.post(room.url + "api/scene", **options)
    assert (answer.status_code, room.editor.version) == (status, 0), answer.text


def test_a_rooms_token_is_asked_for() -> None:
    scene = Scene.load("box_chase")
    runner = Runner(scene.build(), seed=1)
    with served(rules=Rules(token="open sesame"), editor=SceneEditor(runner, scene)) as room:
        for path in ("api/scene", "api/scene/link"):
            assert http_client.get(room.url + path).status_code == 401
            assert http_client.post(room.url + path, json={"link": LINK}).status_code == 401


@pytest.mark.slow
def test_the_routes_are_described(room: Shared) -> None:
    document = room.get("api/openapi.json")
    for path, body in (("/api/scene", {"name": "maze"}), ("/api/scene/link", {"link": LINK})):
        described = document["paths"][path]
        content = described["post"]["requestBody"]["content"]["application/json"]
        checker(document, content["schema"]).validate(body)
        for method, answer in (
            ("get", room.get(path[1:])),
            ("post", room.post(path[1:], **body).json()),
        ):
            content = described[method]["responses"]["200"]["content"]["application/json"]
            checker(document, content["schema"]).validate(answer)


def test_a_room_without_an_editor_opens_nothing() -> None:
    with served() as room:
        assert http_client.get(room.url + "api/scene").status_code == 404
        assert "/api/scene" not in http_client.get(room.url + "api/openapi.json").json()["paths"]


@pytest.mark.parametrize("timeouts", [replace(PATIENT, open_scene=0.05)])
def test_a_world_that_does_not_answer_is_told(room: Shared) -> None:
    is_released = threading.Event()
    room.runner.submit(is_released.wait)
    try:
        answer = room.post("api/scene", name="tag")
    finally:
        is_released.set()
    assert (answer.status_code, answer.headers["Retry-After"]) == (503, "5")
    room.runner.submit(lambda: None).result(LIMIT_S)
    assert room.editor.version == 0  # it is not opened later


def test_own_blocks_are_named(room: Shared) -> None:
    class Mine(Sensor):
        """A sensor of one's own."""

    room.runner.pause().result(LIMIT_S)
    agents = [dict(each) for each in room.editor.state.description.agents]
    agents[0]["sensors"] = [{"type": "Mine"}]
    description = room.editor.state.description.model_copy(update={"agents": tuple(agents)})
    assert shared_link(Scene(description), None).needs == ("Mine",)
