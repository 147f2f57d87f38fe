"""``show`` and ``film``: the live world, and what stands in its place."""

import io
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest
from PIL import Image

from ai4u_edu import CircleShape, Episode, Scene, World
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.lessons import film, filming, live, readiness, ready, show, showing, stop
from ai4u_edu.lessons import notebook_output as out
from ai4u_edu.lessons.live import PageWatch
from ai4u_edu.lessons.rollouts import drives
from tests.builders import small_sim
from tests.page.panel.rooms import PanelPage
from tests.page.server.rooms import Page, raw_answer
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.needs("lessons")


@pytest.fixture(autouse=True)
def ended() -> Iterator[None]:
    yield
    stop()


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str, str]]:
    """Record the output of a notebook: operation, HTML, display handle."""
    cells: list[tuple[str, str, str]] = []
    for module in (showing, filming):
        monkeypatch.setattr(module, "put", lambda p, w, h="": cells.append(("put", p, h)))
    monkeypatch.setattr(live, "replace", lambda p, w, h: cells.append(("replace", p, h)))
    for module in (live, showing):
        monkeypatch.setattr(module, "in_notebook", lambda: True)
    return cells


get = partial(httpx.get, timeout=LIMIT_S)


def drive(percept: Any) -> Any:
    return {"move": [1, 0.2, 0, 0]}


def test_outside_of_a_notebook_the_address_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    world = show("box_chase", seed=4)
    assert capsys.readouterr().out == f"Box chase runs at {world.url}\n"
    assert get(world.url, follow_redirects=True).status_code == 200
    assert world.runner.latest.seed == 4


def test_the_page_can_change_a_scene_and_the_students_function_drives_on() -> None:
    world = show("box_chase", drive, seed=1)
    url = f"http://127.0.0.1:{world.port}/ws/panel?token={live.TOKEN}"
    with PanelPage(url) as page:
        scene = page.part("scene")
        assert (scene["title"], scene["can_edit"], scene["has_past"]) == ("Box chase", True, True)
        page.show("0", "blocks")
        page.done("add_block", **{"class": "GroundStatusSensor", "parent": ["sensors"]})
        until(lambda: "ground_status" in world.sim.agents[0].percept)
        until(lambda: world.runner.latest.agents[0].action.get("move", ())[:2] == (1, 0.2))


def test_a_world_without_a_scene_can_only_be_driven() -> None:
    world = show(small_sim())
    with PanelPage(f"http://127.0.0.1:{world.port}/ws/panel?token={live.TOKEN}") as page:
        assert not page.part("scene")["can_edit"]


def test_who_does_not_know_the_token_neither_sees_nor_drives() -> None:
    world = show("box_chase")
    place = f"http://127.0.0.1:{world.port}/"
    for path in ("", "healthz", "api/snapshot", "web/page/main.js"):
        assert get(place + path).status_code == 401
        assert raw_answer(place + path, "Host: evil.example")[0] == 401
    asks = f"?token={live.TOKEN}"
    assert get(place + "healthz" + asks).status_code == 200
    assert raw_answer(place + "healthz", "Host: hub.example")[0] == 401


def test_the_next_world_ends_the_one_before_and_leaves_its_last_episode(
    shown: list[tuple[str, str, str]],
) -> None:
    first = show("box_chase", drive, seed=1)
    until(lambda: first.runner.latest.tick > 30)
    with Page(f"http://127.0.0.1:{first.port}/ws/input?token={live.TOKEN}") as page:
        second = show("donut")
        page.end()
    assert not first.running
    assert [(what, handle) for what, _, handle in shown] == [
        ("put", first.handle),
        ("put", first.film),
        ("replace", first.film),
        ("replace", first.handle),
        ("put", second.handle),
        ("put", second.film),
    ]
    assert "data:image/png;base64," in shown[0][1]
    assert shown[2][1] == ""
    assert "data:image/gif;base64," in shown[3][1]
    assert "<script" not in shown[3][1]
    assert "<iframe" not in shown[3][1]


def test_a_finished_episode_is_kept_beneath_once(shown: list[tuple[str, str, str]]) -> None:
    world = show("box_chase", drive, seed=1)
    world.keep()
    assert len(shown) == 2  # nothing has come to its end
    until(lambda: world.runner.latest.tick > 10)
    world.runner.reset().result(LIMIT_S)
    world.keep()
    world.keep()
    assert len(shown) == 3
    what, page, handle = shown[-1]
    assert (what, handle) == ("replace", world.film)
    assert page.startswith(f'<div id="{world.film}"><img ')
    assert "data:image/gif;base64," in page


def test_titles_are_escaped_and_end_no_script() -> None:
    scene = Scene.load("box_chase")
    title = '</script><b>"x'
    named = Scene(scene.description.model_copy(update={"title": title}))
    text = show(named).page(300)
    assert title not in text
    assert "&lt;/script&gt;&lt;b&gt;&#34;x" in text
    assert text.count("</script>") == 1
    assert "{{" not in text


def test_a_hub_says_where_its_proxy_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/ann/")
    assert '"hub": "/user/ann/"' in show("box_chase").page(300)


def test_a_person_is_shown_a_world_of_their_own(tmp_path: Path) -> None:
    assert show(small_sim()).title == "Your world"
    world = World()
    with pytest.raises(SetupError, match="a body that can move"):
        show(world)
    world.add_body("ball", CircleShape(radius=1))
    seen = show(world)
    until(lambda: seen.runner.latest.tick > 2)
    with pytest.raises(SetupError, match="expected a scene"):
        show(small_sim(), record=tmp_path)


def test_another_brain_drives_and_its_episodes_are_kept(tmp_path: Path) -> None:
    world = show("box_chase", drive, record=tmp_path / "drives")
    until(lambda: world.runner.latest.agents[0].action.get("move") == (1.0, 0.2, 0.0, 0.0))
    world.runner.reset(9).result(LIMIT_S)
    assert world.episodes[0].agents
    until(lambda: list((tmp_path / "drives").glob("*.episode")))
    assert all(isinstance(each, Episode) for each in world.episodes)


def test_a_scene_that_is_not_there_leaves_the_shown_one_alone() -> None:
    world = show("box_chase")
    with pytest.raises(AI4UError):
        show("box_chaes")
    assert world.running


def test_a_film_moves_and_says_how_it_ended(shown: list[tuple[str, str, str]]) -> None:
    film("box_chase", lambda percept: {"move": [1, 0, 0, 0]}, seed=1)
    ((_, page, _),) = shown
    assert "Seed 1: after " in page
    assert "decisions the robot fell." in page
    assert "data:image/gif;base64," in page


def test_a_film_shows_the_end_of_a_long_episode() -> None:
    from ai4u_edu.lessons.pictures import FRAMES_PER_S, MAX_ANIMATION_S, moving
    from ai4u_edu.snapshot import capture_snapshot

    (done,) = drives("box_chase", drive, [1], limit=1)
    one = capture_snapshot(done.sim)
    gif = Image.open(io.BytesIO(moving([one, one, one], longest=100)))
    assert gif.size == (100, 100)
    assert FRAMES_PER_S * MAX_ANIMATION_S <= 150


def test_words_are_escaped_and_code_is_marked() -> None:
    text = out.card("green", "Right.", ["a `<b>` & c", "one ` alone"])
    assert "a <code>&lt;b&gt;</code> &amp; c" in text
    assert "one ` alone" in text


def test_what_is_missing_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ready()
    assert capsys.readouterr().out.endswith(
        "a robot drove for 1 s of its time.\nEverything is there.\n"
    )
    hidden = {"torch", "onnx"}
    monkeypatch.setattr(readiness, "find_spec", lambda name: None if name in hidden else name)
    ready()
    assert "Install torch, onnx for the lessons about learning" in capsys.readouterr().out


def test_a_world_ends_when_its_page_is_gone_and_not_before_there_was_one() -> None:
    counts = iter([0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0])
    seen: list[int] = []
    gone: list[int] = []

    def count() -> int:
        seen.append(next(counts))
        return seen[-1]

    watch = PageWatch(count, lambda: gone.append(len(seen)), gone_s=0.021, poll_s=0.005)
    watch.start()
    until(lambda: bool(gone))
    assert seen == [0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0]  # a reload is not the end


def test_the_shown_world_is_forgotten_when_its_page_is_gone() -> None:
    world = show("box_chase")
    showing._end(world)
    assert not world.running
    assert show("box_chase").running
