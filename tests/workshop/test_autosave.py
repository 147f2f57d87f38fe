"""What nobody saved is there again."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.errors import SetupError
from ai4u_edu.workshop import Workshop, autosave
from ai4u_edu.workshop.autosave import Autosave, latest
from tests.workshop.kill_autosaves import run
from tests.workshop.shops import Shop


@pytest.fixture
def saver(tmp_path: Path) -> Autosave:
    return Autosave(tmp_path / "deep" / "unsaved", "small/../scene")


def test_a_changed_scene_is_written_and_read(saver: Autosave, tmp_path: Path) -> None:
    shop = Shop()
    shop.workshop.listeners.append(saver.note)
    shop.done(shop.workshop.add_body({"name": "ball", "position": [0, 3]}))
    shop.done(shop.workshop.move_body("ball", 1, 3))
    saver.stop()
    assert shop.workshop.is_as_opened is False
    (file,) = (tmp_path / "deep" / "unsaved").iterdir()
    assert file.name == "small____scene.unsaved"
    unsaved = latest(file.parent)
    assert unsaved is not None
    assert unsaved.scene() == shop.workshop.scene
    assert len(unsaved.when) == 5


def test_what_was_taken_back_is_not_offered(tmp_path: Path) -> None:
    shop, saver = Shop(), Autosave(tmp_path, "small")
    shop.workshop.autosave = saver
    shop.done(shop.workshop.add_body({"name": "ball", "position": [0, 3]}))
    shop.done(shop.workshop.open(Scene.load("sumo")))
    saver.stop()
    unsaved = latest(tmp_path)  # of a scene that is only looked at nothing is lost
    assert unsaved is not None
    assert "ball" in unsaved.text
    shop.workshop.autosave = saver = Autosave(tmp_path, "small")
    shop.done(shop.workshop.undo())
    shop.done(shop.workshop.undo())
    saver.stop()
    assert latest(tmp_path) is None


def test_it_is_brought_back_or_forgotten(tmp_path: Path) -> None:
    left, saver = Shop(), Autosave(tmp_path, "small")
    left.workshop.autosave = saver
    left.done(left.workshop.add_body({"name": "ball", "position": [0, 3]}))
    saver.stop()
    shop = Shop()
    shop.workshop.unsaved = latest(tmp_path)
    shop.done(shop.workshop.bring_back())
    assert shop.workshop.scene == left.workshop.scene
    assert shop.workshop.unsaved is None
    shop.done(shop.workshop.undo())
    assert "ball" not in shop.world.bodies
    shop.workshop.autosave = saver = Autosave(tmp_path, "small")
    shop.workshop.forget()
    saver.stop()
    assert latest(tmp_path) is None
    with pytest.raises(SetupError, match="there is no unsaved scene"):
        shop.done(shop.workshop.bring_back())


def test_many_changes_are_written_once(saver: Autosave, monkeypatch: pytest.MonkeyPatch) -> None:
    written = []
    monkeypatch.setattr(autosave, "_write", lambda _file, state: written.append(state))
    state = Shop().workshop.state
    for number in range(100):
        state = state.describing(title=str(number))
        saver.note(state)
    saver.stop()
    assert [each.description.title for each in written][-1] == "99"
    assert len(written) <= 3


def test_what_is_no_such_file_is_not_offered(tmp_path: Path) -> None:
    for name, text in (("a", "{"), ("b", "[]"), ("c", '{"text": "x"}'), ("d", "\0")):
        (tmp_path / f"{name}.unsaved").write_text(text)
    assert latest(tmp_path) is None
    assert latest(tmp_path / "nowhere") is None


def test_a_disk_that_is_full_stops_nothing(saver: Autosave, tmp_path: Path) -> None:
    (tmp_path / "deep" / "unsaved").rmdir()
    saver.note(Shop().workshop.state)
    saver.stop()


def test_a_killed_server_leaves_it_whole() -> None:
    assert run(2) == []


def test_the_command_line_restores(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "ai4u_edu", "play", "--restore", "--no-open"]
    environment = {**os.environ, "XDG_STATE_HOME": str(tmp_path)}
    told = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert told.returncode == 1
    assert told.stderr == "error: there is no unsaved scene; expected: ai4u-edu play SCENE\n"


def test_nothing_is_kept_unless_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    shop = Shop(Scene.load("box_chase"))
    assert isinstance(shop.workshop, Workshop)
    shop.done(shop.workshop.add_body({"name": "ball", "position": [0, 3]}))
    assert list(tmp_path.iterdir()) == []
