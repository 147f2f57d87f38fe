"""Kept episodes are listed and handed out, to whoever may come in."""

import csv
import io
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from itertools import islice
from pathlib import Path
from threading import Event

import httpx
import pytest
from PIL import Image

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.page.server import Rules, ServerThread, past, room_app
from ai4u_edu.page.server.past import WRITERS
from ai4u_edu.recording import Episode, Recorder, RecordingError, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.runtime.runner import Runner
from tests.page.server import http_client
from tests.page.server.rooms import NOWHERE, PATIENT, raw_request
from tests.waiting import LIMIT_S, until

TOKEN = "sesame sesame"
BEARER = f"Bearer {TOKEN}"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A room that has two episodes, of the seeds 5 and 6."""
    yield from _served()


@pytest.fixture
def fresh() -> Iterator[str]:
    """Such a room that has made no files yet."""
    yield from _served()


def _served() -> Iterator[str]:
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [0.1, 0.3, 0, 0]}))
    recorder = Recorder(sim, scene=Scene.load("box_chase").description)
    runner = Runner(sim, seed=5, recorder=recorder)
    for seed in (6, None):
        for _ in range(12):
            sim.step()
        sim.reset(seed)
    app = room_app(runner, viser_port=NOWHERE, title="Box chase", rules=Rules(token=TOKEN))
    with ServerThread(app, timeouts=PATIENT) as server:
        yield server.url
    runner.stop(LIMIT_S)


def get(address: str, path: str) -> httpx.Response:
    return http_client.get(f"{address}api/past{path}", params={"token": TOKEN})


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


def test_a_picture_shows_where_an_episode_began(address: str) -> None:
    answers = [get(address, f"/{number}.png") for number in (1, 2)]
    for answer in answers:
        assert answer.headers["content-type"] == "image/png"
        assert max(Image.open(io.BytesIO(answer.content)).size) == 160
    assert answers[0].content != answers[1].content  # other starts
    assert get(address, "/9.png").status_code == 404


def test_unknown_episodes_and_formats_get_404(address: str) -> None:
    answer = get(address, "/7.html")
    assert (answer.status_code, answer.text) == (404, "no episode 7 is kept; there are 1, 2\n")
    for name in ("1.pickle", "x.html", "..%2f1.html", "1", "٣.html"):
        answer = get(address, f"/{name}")
        assert answer.status_code == 404, name


def test_one_that_was_made_is_not_made_again(fresh: str, monkeypatch: pytest.MonkeyPatch) -> None:
    first = get(fresh, "/2.html")
    monkeypatch.setattr(past, "WRITERS", {"html": (WRITERS["html"][0], _fail)})
    assert get(fresh, "/2.html").content == first.content
    assert first.headers["Content-Length"] == str(len(first.content))
    answer = get(fresh, "/1.html")
    assert (answer.status_code, answer.text) == (409, "it can't be\n")


def test_simultaneous_exports_share_one_file_and_the_queue_has_a_limit(
    fresh: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(past, "MAX_QUEUED", 1)
    is_going_on, made = Event(), list[Path]()

    def write(replay: Replay, path: Path) -> Path:
        made.append(path)
        assert is_going_on.wait(LIMIT_S)
        path.write_text("made")
        return path

    monkeypatch.setattr(past, "WRITERS", {"csv": ("text/csv", write), "mp4": ("video/mp4", write)})
    with ThreadPoolExecutor(16) as pool:
        under_way = [pool.submit(get, fresh, "/1.csv") for _ in range(12)]
        until(lambda: made)
        others = [pool.submit(get, fresh, path) for path in ("/2.csv", "/1.mp4", "/2.mp4")]
        first, second = islice(as_completed(others), 2)
        assert (first.result().status_code, second.result().status_code) == (503, 503)
        refused = first.result()
        assert refused.text == (
            "expected at most 1 files that wait to be made, got another one; try again in a "
            "moment\n"
        )
        assert int(refused.headers["Retry-After"]) > 0
        assert get(fresh, "").status_code == 200
        is_going_on.set()
        assert {each.result().text for each in under_way} == {"made"}
        assert sorted(each.result().status_code for each in others) == [200, 503, 503]
    assert len(made) == 2


def test_those_who_wait_leave_connections_for_others(
    fresh: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(past, "MAX_WAITING", 2)
    is_going_on = Event()

    def write(replay: Replay, path: Path) -> Path:
        assert is_going_on.wait(LIMIT_S)
        path.write_text("made")
        return path

    monkeypatch.setattr(past, "WRITERS", {"csv": ("text/csv", write)})
    with ThreadPoolExecutor(5) as pool:
        asked = [pool.submit(get, fresh, "/1.csv") for _ in range(5)]
        for refused in islice(as_completed(asked), 3):
            assert refused.result().status_code == 503
        is_going_on.set()
        assert sorted(each.result().status_code for each in asked) == [200, 200, 503, 503, 503]


def test_export_is_cancelled_when_its_client_leaves(
    fresh: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []

    def write(replay: Replay, path: Path) -> Path:
        told.append("begun")
        try:
            while True:
                for _ in replay.snapshots():
                    pass
        finally:
            told.append("ended")

    monkeypatch.setattr(past, "WRITERS", {"mp4": ("video/mp4", write), "gif": ("image/gif", write)})
    with raw_request(f"{fresh}api/past/1.mp4", "Host: localhost", f"Authorization: {BEARER}"):
        until(lambda: told == ["begun"])
        path = f"{fresh}api/past/1.gif"
        with raw_request(path, "Host: localhost", f"Authorization: {BEARER}"):
            pass
    until(lambda: told[:2] == ["begun", "ended"])
    monkeypatch.undo()
    assert get(fresh, "/1.csv").status_code == 200
    until(lambda: not any(thread.name == "exports" for thread in threading.enumerate()))


def _fail(replay: Replay, path: Path) -> Path:
    raise RecordingError("it can't be")


def test_nobody_gets_them_without_the_token(address: str) -> None:
    for path in ("", "/1.episode"):
        assert http_client.get(f"{address}api/past{path}").status_code == 401
