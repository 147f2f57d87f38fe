"""Pictures on the ground of a scene: sensors see them, and they go wherever the scene goes."""

import base64
import io
import zipfile
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.games.tournament.game import game
from ai4u_edu.member.my_work import open_my_work
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.autosave import Autosave, latest
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.editing.sharing import shared_link
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.exports.html_page import write_html
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.scene_data import scene_data, scene_from
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.wire.class_link import MAX_SENT_SCENE_CHARS, Assignment
from ai4u_edu.world.pictures import MAX_PICTURE_CHARS, picture_data
from tests.member.fake_link import joined
from tests.member.test_assignment import applied
from tests.waiting import LIMIT_S

TEXT = """\
name: mat
floors: [{name: ground, shape: {type: box, size: [9, 7]}}]
areas:
  - name: mat  # a mat of four metres
    shape: {type: box, size: [4, 2]}
    picture: mat.png  # beside this file
bodies:
  - name: robot
    shape: {type: circle, radius: 0.2}
agents:
  - body: robot
    sensors:
      - {type: LineSensor, points: 3, ahead: 0, width: 1}
      - {type: ColourSensor, ahead: 0}
    actuators: [{type: RBMoveActuator}, {type: PenActuator, colours: [white]}]
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
"""


def png(image: Image.Image) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG")
    return out.getvalue()


def track(colour: tuple[int, int, int] = (20, 20, 90)) -> bytes:
    """Return a white mat with a dark band along its middle, a fifth as wide."""
    pixels = np.full((50, 100, 3), 255, np.uint8)
    pixels[20:30] = colour
    return png(Image.fromarray(pixels))


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "mat.png").write_bytes(track())
    path = tmp_path / "mat.yaml"
    path.write_text(TEXT)
    return path


@pytest.fixture
def scene(file: Path) -> Scene:
    return Scene.load(file)


def percept_of(scene: Scene, **described: Any) -> Any:
    """Return the first percept in a scene with other fields of its description."""
    sim = Scene(scene.description.model_copy(update=described)).build()
    sim.reset(1)
    return sim.agents[0].percept


def test_sensors_see_it(scene: Scene) -> None:
    percept = percept_of(scene)
    assert percept["line"].tolist() == [0, 1, 0]
    assert percept["colour"][:3] == pytest.approx([20 / 255, 20 / 255, 90 / 255])
    robot = scene.description.bodies[0]
    away = percept_of(scene, bodies=(robot.model_copy(update={"position": (0, 3)}),))
    assert away["line"].tolist() == [0, 0, 0]


def test_paint_and_ink_lie_on_it(scene: Scene) -> None:
    (mat,) = scene.description.areas
    patch = mat.model_copy(
        update={"name": "patch", "picture": None, "paint": True, "colour": "yellow"}
    )
    for areas in ((mat, patch), (patch, mat)):
        percept = percept_of(scene, areas=areas)
        assert percept["line"].tolist() == [0, 0, 0]
        assert percept["colour"][:2] == pytest.approx([0xF0 / 255, 0xE4 / 255])
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"pen": [1.0], "move": [1, 0, 0, 0]}))
    sim.reset(1)
    for _ in range(10):
        percept = sim.step()
    assert percept["colour"].tolist() == [1, 1, 1, 1]
    assert percept["line"].tolist() == [0, 1, 0], "ink of any colour is a line"


def test_transparent_pixels_show_what_is_under_them(scene: Scene, file: Path) -> None:
    glass = png(Image.new("RGBA", (4, 4), (0, 0, 0, 0)))
    (mat,) = scene.description.areas
    pane = mat.model_copy(update={"name": "pane", "picture": picture_data(glass)})
    assert percept_of(scene, areas=(mat, pane))["line"].tolist() == [0, 1, 0]


def test_its_text_has_the_picture_and_keeps_the_comments(scene: Scene, tmp_path: Path) -> None:
    text = scene.dumps()
    assert "mat.png" not in text
    assert "# beside this file" in text
    assert "# a mat of four metres" in text
    assert Scene.loads(text) == scene
    written = Scene(scene.description).dumps()
    assert Scene.loads(written) == scene
    store = SceneStore(tmp_path / "kept")
    store.save("mine", scene)
    assert store.load("mine") == scene


def finish(runner: Runner, change: Future[Any]) -> None:
    """Advance a world until a change is made."""
    for _ in range(10):
        if not change.done():
            runner.advance()
    change.result(0)


def test_a_job_and_an_edited_world_have_it(scene: Scene, file: Path) -> None:
    data = scene_data(str(file))
    (file.parent / "mat.png").unlink()
    assert scene_from(data) == scene
    runner = Runner(scene.build(), seed=1)
    editor = SceneEditor(runner, scene)
    finish(runner, editor.move_body("mat", 1.0, 0.5))
    assert Scene.loads(editor.text()).description.areas[0].position == (1.0, 0.5)
    finish(runner, editor.undo())
    assert Scene.loads(editor.text()) == scene


def recorded(scene: Scene) -> Episode:
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(5)
    for _ in range(10):
        sim.step()
    recorder.finish()
    return recorder.episodes[-1]


def test_an_episode_has_it_and_replays(scene: Scene, tmp_path: Path) -> None:
    episode = Episode.load(recorded(scene).save(tmp_path / "drive.episode"))
    assert episode.scene.pictures == scene.description.pictures
    assert Replay(episode).verdict.exact
    assert Player(episode).sim.world.described == scene.description.things


def test_a_replay_with_another_picture_is_not_exact(scene: Scene, tmp_path: Path) -> None:
    episode = recorded(scene)
    (mat,) = episode.scene.areas
    white = mat.model_copy(update={"picture": picture_data(track((255, 255, 255)))})
    other = episode.scene.model_copy(update={"areas": (white,)})
    assert not Replay(replace(episode, scene=other)).verdict.exact


def test_a_changed_scene_is_restored_with_it(scene: Scene, tmp_path: Path) -> None:
    runner, saver = Runner(scene.build(), seed=1), Autosave(tmp_path, "mat")
    editor = SceneEditor(runner, scene)
    editor.recovery.autosave = saver
    finish(runner, editor.move_body("mat", 1.0, 0.5))
    saver.stop()
    left = latest(tmp_path)
    assert left is not None
    assert left.scene() == editor.scene
    assert left.scene().description.pictures == scene.description.pictures


def test_my_work_has_it(scene: Scene, tmp_path: Path) -> None:
    recorded(scene).save(tmp_path / "mat-5.episode")
    with zipfile.ZipFile(tmp_path / "my-work.zip", "w") as archive:
        archive.writestr("scene.yaml", scene.dumps())
        archive.writestr("scenes/A mat.yaml", scene.dumps())
        archive.write(tmp_path / "mat-5.episode", "episodes/mat-5.episode")
    work = open_my_work(tmp_path / "my-work.zip")
    assert Scene.load(work.scene) == scene
    assert SceneStore(work.scenes).load("A mat") == scene
    assert Replay(Episode.load(work.episodes / "mat-5.episode")).verdict.exact


def test_a_class_assigns_it_and_keeps_what_a_student_made_of_it(
    scene: Scene, tmp_path: Path
) -> None:
    pictures = scene.description.pictures
    with joined(folder=tmp_path) as room:
        room.tell(Assignment("a", "A mat", scene.dumps(), 3))
        assert applied(room, "a") == ""
        assert room.editor.state.description.pictures == pictures
        room.editor.move_body("mat", 1.0, 0.5).result(LIMIT_S)
        room.tell(Assignment("b", "Maze", "maze", 7))
        assert applied(room, "b") == ""
        store = room.editor.scene_store
        assert store is not None
        (name,) = store.names()
        assert store.load(name).description.pictures == pictures


def test_games_of_a_tournament_are_played_and_recorded_on_it(file: Path) -> None:
    entry = {"name": "a", "drivers": {"": {"kind": "random"}}}
    told = game(scene_data(str(file)), 3, [entry])
    assert told["reason"] == ""
    episode = decode(Episode, base64.b64decode(told["episode"]), "game")
    assert episode.scene.pictures == Scene.load(file).description.pictures
    assert Replay(episode).verdict.exact


def test_a_running_world_and_a_page_are_exported_with_it(scene: Scene, tmp_path: Path) -> None:
    exported = export_scene(scene.build(), scene.description)
    assert Scene.loads(Scene(exported).dumps()).description.pictures == scene.description.pictures
    page = write_html(Replay(recorded(scene)), tmp_path / "drive.html").read_text(encoding="utf-8")
    (picture,) = scene.description.pictures
    assert picture in page


def test_a_link_says_that_it_cannot_carry_it(scene: Scene) -> None:
    with pytest.raises(SceneError, match="a link can't carry the picture on the ground"):
        shared_link(scene, 1)


def test_pictures_of_a_scene_have_one_limit(scene: Scene) -> None:
    large = picture_data(png(Image.new("1", (1900, 1900))))
    text = scene.dumps()
    two = text.replace(
        "areas:\n", f"areas:\n  - {{name: b, shape: {{type: box}}, picture: '{large}'}}\n"
    )
    assert len(Scene.loads(two).description.pictures) == 2
    three = two.replace(
        "areas:\n", f"areas:\n  - {{name: c, shape: {{type: box}}, picture: '{large}'}}\n"
    )
    with pytest.raises(SceneError, match=r"together at most 1 MB and 4 megapixels, got .* 7\.2"):
        Scene.loads(three)


def test_a_large_picture_fits_into_a_file_and_a_class(scene: Scene) -> None:
    noise = np.random.default_rng(1).integers(0, 255, (580, 600, 3), np.uint8)
    data = picture_data(png(Image.fromarray(noise)))
    assert len(data) > MAX_SCENE_CHARS
    assert MAX_PICTURE_CHARS + 200_000 <= MAX_SENT_SCENE_CHARS
    (mat,) = scene.description.areas
    areas = (mat.model_copy(update={"picture": data}),)
    large = Scene(scene.description.model_copy(update={"areas": areas}))
    assert Scene.loads(large.dumps()) == large
    with pytest.raises(SceneError, match="expected at most"):
        Scene.loads(large.dumps() + "#" * MAX_SCENE_CHARS)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        (
            "none.png",
            r"line 6: the picture 'none.png' can't be read: No such file.*beside the file",
        ),
        ("bad.png", "line 6: bad.png: expected a PNG or JPEG file"),
        ("../mat.png", r"areas\[0\].picture: expected data:image/png"),
        ("/etc/mat.png", r"areas\[0\].picture: expected data:image/png"),
    ],
)
def test_a_picture_that_is_not_there_gets_a_sentence(file: Path, name: str, told: str) -> None:
    (file.parent / "bad.png").write_text("no picture")
    file.write_text(TEXT.replace("mat.png", name))
    with pytest.raises(SceneError, match=told):
        Scene.load(file)


def test_a_text_without_a_folder_names_no_files() -> None:
    with pytest.raises(SceneError, match="lay the picture in the tab World"):
        Scene.loads(TEXT)


@pytest.mark.parametrize("heading", [0, 30])
def test_pictures_without_a_browser_show_it(scene: Scene, heading: float) -> None:
    (mat,) = scene.description.areas
    turned = mat.model_copy(update={"heading_deg": heading, "position": (0.0, 2.0)})
    sim = Scene(scene.description.model_copy(update={"areas": (turned,)})).build()
    sim.reset(1)
    snapshot = capture_snapshot(sim)
    drawn = draw_snapshot(snapshot, longest=300)
    dark = (np.abs(drawn.astype(int) - (20, 20, 90)) < 30).all(axis=2)
    rows, columns = np.nonzero(dark)
    assert len(rows) > 300
    slope = np.polyfit(columns, -rows, 1)[0]
    assert slope == pytest.approx(np.tan(np.radians(heading)), abs=0.1)
