"""The start page: its scenes with pictures, and its missions."""

import io
import re
from collections.abc import Iterator

import pytest
from PIL import Image

from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.server import MissionsView, Rules
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.description import LEVELS
from tests.page.server import http_client
from tests.page.server.rooms import Room, served
from tests.page.server.test_api import checker

TOKEN = "open sesame"
MISSIONS = MissionsView.model_validate(
    {
        "missions": [
            {
                "name": "go",
                "title": "Go",
                "island": "Drive",
                "minutes": 3,
                "steps": 2,
                "stars": 1,
                "idea": "body",
                "scene": "maze",
            }
        ],
        "problems": ["a.yaml, line 1: wrong"],
    }
)


@pytest.fixture(scope="module")
def editor() -> SceneEditor:
    scene = Scene.load("box_chase")
    return SceneEditor(Runner(scene.build(), seed=1), scene)


@pytest.fixture(scope="module")
def room(editor: SceneEditor) -> Iterator[Room]:
    with served(editor=editor, missions=lambda: MISSIONS) as room:
        yield room


def test_all_scenes_are_listed_the_easiest_first(room: Room) -> None:
    scenes = http_client.get(room.url + "api/scenes").json()["scenes"]
    assert sorted(each["name"] for each in scenes) == Scene.names()
    levels = [(*LEVELS, "").index(each["level"]) for each in scenes]
    assert levels == sorted(levels)
    for each in scenes:
        about = Scene.load(each["name"]).description
        assert each["title"] == about.title
        assert (each["goal"], each["minutes"]) == (about.goal, about.minutes)
        assert each["key"] == about.task_key()


def test_each_scene_has_a_picture(room: Room) -> None:
    for each in http_client.get(room.url + "api/scenes").json()["scenes"]:
        answer = http_client.get(room.url + each["picture"])
        assert answer.headers["Content-Type"] == "image/png"
        picture = Image.open(io.BytesIO(answer.content))
        assert max(picture.size) == 400
        assert len(picture.convert("RGB").getcolors(400 * 400) or ()) > 2
        assert len(answer.content) < 20_000


def test_browsers_keep_a_picture_until_it_is_another_one(room: Room) -> None:
    scenes = http_client.get(room.url + "api/scenes").json()["scenes"]
    (address,) = [each["picture"] for each in scenes if each["name"] == "maze"]
    answer = http_client.get(room.url + address)
    assert "immutable" in answer.headers["Cache-Control"]
    url = room.url + address.partition("?")[0]
    assert http_client.get(url).headers["Cache-Control"] == "no-cache"
    known = http_client.get(url, headers={"If-None-Match": answer.headers["ETag"]})
    assert (known.status_code, known.content) == (304, b"")


@pytest.mark.parametrize("name", ["box_chase", "nothing.png", "..%2fmaze.png", "my_scene.png"])
def test_unknown_scene_pictures_get_404(room: Room, name: str) -> None:
    assert http_client.get(f"{room.url}api/scenes/{name}").status_code == 404


def test_missions_are_listed(room: Room) -> None:
    assert http_client.get(room.url + "api/missions").json() == MISSIONS.model_dump()


def test_the_page_runs_our_files_only(room: Room) -> None:
    answer = http_client.get(room.url + "start")
    assert answer.status_code == 200
    assert "default-src 'none'; script-src 'self'" in answer.headers["Content-Security-Policy"]
    files = re.findall(r'(?:href|src)="\./(web-[^"]*)"', answer.text)
    assert files
    for file in files:
        assert http_client.get(room.url + file).status_code == 200


def test_another_site_may_lead_a_person_to_the_page(room: Room) -> None:
    led = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate"}
    assert http_client.get(room.url + "start", headers=led).status_code == 200
    assert http_client.get(room.url + "api/scenes", headers=led).status_code == 403


def test_the_routes_are_described(room: Room) -> None:
    document = http_client.get(room.url + "api/openapi.json").json()
    assert "/api/scenes/{file}" in document["paths"]
    for path in ("/api/scenes", "/api/missions"):
        described = document["paths"][path]["get"]["responses"]["200"]["content"]
        answer = http_client.get(room.url + path[1:]).json()
        checker(document, described["application/json"]["schema"]).validate(answer)


def test_the_token_is_asked_for_and_leads_back_to_the_page(editor: SceneEditor) -> None:
    with (
        served(editor=editor, rules=Rules(token=TOKEN)) as room,
        http_client.Client(base_url=room.url) as browser,
    ):
        paths = ("start", "api/scenes", "api/scenes/maze.png", "api/missions")
        for path in paths:
            assert browser.get(path).status_code == 401
        asked = browser.get("start", headers={"Accept": "text/html"})
        assert "This world is protected" in asked.text
        answer = browser.get("start", params={"token": TOKEN})
        assert (answer.status_code, answer.headers["Location"]) == (303, "./start")
        for path in paths:
            assert browser.get(path).status_code == 200


def test_a_room_without_an_editor_has_no_start_page() -> None:
    with served() as room:
        assert http_client.get(room.url + "start").status_code == 404


def test_scenes_of_the_library_have_a_level_and_minutes() -> None:
    for name in ("box_chase", "soccer"):
        about = Scene.load(name).description
        assert about.level in LEVELS
        assert about.minutes is not None
