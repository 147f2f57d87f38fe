"""Kept episodes are listed and handed out, to whoever may come in."""

import csv
import io
from collections.abc import Iterator

import httpx
import pytest
from PIL import Image

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.recording.file import decode
from ai4u_edu.runner import Runner
from ai4u_edu.server import Rules, ServerThread, room_app
from tests.server.rooms import NOWHERE

TOKEN = "sesame sesame"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A room that has two episodes, of the seeds 5 and 6."""
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [0.1, 0.3, 0, 0]}))
    recorder = Recorder(sim, scene=Scene.load("box_chase").description)
    runner = Runner(sim, seed=5, recorder=recorder)
    for seed in (6, None):
        for _ in range(12):
            sim.step()
        sim.reset(seed)
    app = room_app(runner, viser_port=NOWHERE, title="Box chase", rules=Rules(token=TOKEN))
    with ServerThread(app) as server:
        yield server.url
    runner.stop()


def get(address: str, path: str) -> httpx.Response:
    return httpx.get(f"{address}api/past{path}", params={"token": TOKEN}, timeout=30)


def test_they_are_listed(address: str) -> None:
    episodes = get(address, "").json()["episodes"]
    assert [(each["number"], each["seed"], each["decisions"]) for each in episodes] == [
        (1, 5, 12),
        (2, 6, 12),
    ]
    assert episodes[0]["scene"] == "box_chase"
    assert episodes[0]["driver"] == "LocalBrain(ScriptController)"
    assert episodes[0]["success"] is False


def test_a_recording_plays_again(address: str) -> None:
    answer = get(address, "/2.episode")
    assert answer.headers["Content-Disposition"] == 'attachment; filename="box_chase_6.episode"'
    episode = decode(Episode, answer.content, "2.episode")
    assert episode.seed == 6
    assert Replay(episode).verdict.exact


def test_the_other_files_are_what_they_say(address: str) -> None:
    page = get(address, "/1.html")
    assert page.headers["Content-Type"] == "text/html; charset=utf-8"
    assert "sandbox" in page.headers["Content-Security-Policy"]
    assert page.text.startswith("<!DOCTYPE html>")
    assert '"seed":"5"' in page.text
    rows = list(csv.DictReader(io.StringIO(get(address, "/1.csv").text)))
    assert len(rows) == 12
    with Image.open(io.BytesIO(get(address, "/1.gif").content)) as picture:
        assert getattr(picture, "n_frames", 1) > 5


def test_what_there_is_not_is_said(address: str) -> None:
    answer = get(address, "/7.html")
    assert (answer.status_code, answer.text) == (404, "no episode 7 is kept; there are 1, 2\n")
    for name in ("1.pickle", "x.html", "..%2f1.html", "1", "٣.html"):
        answer = get(address, f"/{name}")
        assert answer.status_code == 404, name


def test_nobody_gets_them_without_the_token(address: str) -> None:
    for path in ("", "/1.episode"):
        assert httpx.get(f"{address}api/past{path}").status_code == 401
