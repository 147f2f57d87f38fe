"""Episodes as tables, pictures and pages."""

import csv
import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageSequence

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.recording import Recorder, RecordingError, Replay
from ai4u_edu.recording.exports.csv_file import write_csv
from ai4u_edu.recording.exports.html_page import write_html
from ai4u_edu.recording.exports.movie import write_gif, write_mp4
from ai4u_edu.snapshot.raster import draw_snapshot
from tests.recording.recorded_drives import Take, take

pytestmark = pytest.mark.needs("video")

imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")


@pytest.fixture(scope="module")
def taken() -> Take:
    return take("box_chase", decisions=25)


@pytest.fixture(scope="module")
def replay(taken: Take) -> Replay:
    return Replay(taken.episode)


def test_a_row_for_each_decision(taken: Take, replay: Replay, tmp_path: Path) -> None:
    path = write_csv(replay, tmp_path / "one.csv")
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 25
    for row, note in zip(rows, taken.notes["0"], strict=True):
        assert float(row["time"]) == pytest.approx(note.tick / 60)
        assert [float(row[f"move[{i}]"]) for i in range(4)] == list(note.action["move"])
        assert float(row["reward:min_dist"]) == note.terms["min_dist"]
        readings = np.frombuffer(note.percept, np.float32, 120)
        assert [float(row[f"vision[{i}]"]) for i in range(120)] == readings.tolist()


def test_every_agent_is_in_the_table(tmp_path: Path) -> None:
    path = write_csv(Replay(take("tag", decisions=8).episode), tmp_path / "tag.csv")
    with path.open(newline="") as file:
        assert {row["agent"] for row in csv.DictReader(file)} == {
            "chaser",
            "runner_1",
            "runner_2",
            "runner_3",
        }


def test_a_name_is_no_formula(tmp_path: Path) -> None:
    replay = named("-x", "move")
    text = write_csv(replay, tmp_path / "x.csv").read_text()
    assert "\n'-x,0,0,0.0," in text
    assert "\n-x" not in text


def test_a_gif_at_the_worlds_pace(replay: Replay, tmp_path: Path) -> None:
    with Image.open(write_gif(replay, tmp_path / "one.gif", longest=120)) as gif:
        pictures = {each.tick: each for each in replay.snapshots()}
        time = 0
        for _ in ImageSequence.Iterator(gif):  # those that are like the one before are left out
            shown = np.asarray(gif.convert("RGB"), np.int16)
            drawn = draw_snapshot(pictures[min(time * 60 // 1000, max(pictures))], longest=120)
            assert np.abs(shown - drawn).mean() < 6  # but for the few colours
            time += gif.info["duration"]
        assert time == (125 // 3 + 1) * 50 + 1500


def test_an_mp4(replay: Replay, tmp_path: Path) -> None:
    path = write_mp4(replay, tmp_path / "one.mp4", longest=121)
    count, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert count == 125 // 2 + 1
    assert seconds == pytest.approx(count / 30, abs=0.02)
    assert path.read_bytes()[4:8] == b"ftyp"


def test_an_mp4_that_can_not_be_written(replay: Replay, tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"the video can't be written: .*No such file"):
        write_mp4(replay, tmp_path / "nowhere" / "one.mp4")


def test_an_mp4_without_the_extra(
    replay: Replay, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.base.optional_deps.find_spec", lambda name: None)
    with pytest.raises(SetupError, match=r'pip install "ai4u-edu\[video\]"'):
        write_mp4(replay, tmp_path / "one.mp4")


def named(agent: str, action: str = "move", **texts: Any) -> Replay:
    """An episode with names and texts of one's own."""
    source = Scene.load("box_chase").plain() | texts
    source["agents"][0]["id"] = agent
    scene = Scene(Scene.load("box_chase").description.model_validate(source))
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda percept: {action: [0.2, 1, 0, 0]}))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(1)
    for _ in range(10):
        sim.step()
    recorder.finish()
    return Replay(recorder.episodes[-1])


HOSTILE = (
    "</script><script>document.title='taken'</script><img src=http://x.invalid/ onerror=alert(1)>"
)


def test_texts_stay_texts_in_the_page(tmp_path: Path) -> None:
    text = write_html(named("0", title=HOSTILE, goal="&lt;b> \u2028 ' \""), tmp_path / "x.html")
    page = text.read_text(encoding="utf-8")
    assert page.count("<script>") == page.count("</script>") == 1
    assert "<img" not in page
    (data,) = re.findall(r"const episode = (.*);\n", page)
    assert json.loads(data)["title"] == HOSTILE
    assert json.loads(data)["goal"] == "&lt;b> \u2028 ' \""


def test_the_page_asks_for_nothing(replay: Replay, tmp_path: Path) -> None:
    page = write_html(replay, tmp_path / "x.html").read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert not re.findall(r"https?://|src=|@import|url\(", page)


@pytest.mark.browser
def test_the_page_plays_without_a_server(tmp_path: Path) -> None:
    from tests.chromium import browser, new_page

    taken = take("tag", decisions=60)
    path = write_html(Replay(taken.episode), tmp_path / "tag.html")
    hostile = write_html(named("0", title=HOSTILE), tmp_path / "hostile.html")
    asked: list[str] = []
    errors: list[str] = []
    with browser() as chromium:
        page = new_page(chromium)
        page.clock.install(time=0)
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda message: errors.append(message.text))
        page.goto(path.as_uri())
        page.clock.pause_at(24 * 3600)
        assert page.title() == "Tag"
        pixels = "() => document.getElementById('world').toDataURL()"
        first = page.evaluate(pixels)
        page.locator("#time").fill("75")
        note = next(each for each in taken.notes["chaser"] if each.tick == 150)
        assert page.locator("#clock").text_content() == "2.50 s"
        assert page.locator("#step").text_content() == "Decision 30 of 59"
        shown = page.locator("#action").text_content() or ""
        assert all(f"{number:.3f}" in shown for number in note.action["move"] if number % 1)
        assert page.evaluate(pixels) != first
        page.locator("#agent").select_option(label="runner_2")
        assert "pursuer" in (page.locator("#readings").text_content() or "")
        page.locator("#play").click()
        assert page.locator("#play").text_content() == "Pause"
        page.clock.run_for(500)
        played = page.locator("#clock").text_content() or ""
        assert 2.7 < float(played.removesuffix(" s")) <= 3.0
        page.keyboard.press("Tab")
        page.locator("#play").click()
        assert page.locator("#play").text_content() == "Play"
        page.clock.run_for(500)
        assert page.locator("#clock").text_content() == played
        page.goto(hostile.as_uri())
        assert page.locator("h1").text_content() == HOSTILE
        assert page.title() == HOSTILE
    assert asked == [path.as_uri(), hostile.as_uri()]
    assert errors == []


def test_exporting_needs_no_browser_and_no_page() -> None:
    code = (
        "import sys, ai4u_edu.recording.exports.movie, ai4u_edu.recording.exports.html_page, "
        "ai4u_edu.recording.exports.csv_file\n"
        "assert not {'viser', 'torch', 'starlette', 'imageio_ffmpeg'} & set(sys.modules)"
    )
    import subprocess

    subprocess.run([sys.executable, "-c", code], check=True)
