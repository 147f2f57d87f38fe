"""Autosave: unsaved edits can be restored."""

import errno
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from threading import Event, Semaphore

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.page.editing import EditState, SceneEditor, autosave, unsaved
from ai4u_edu.page.editing.autosave import Autosave, latest, unsaved_scenes
from ai4u_edu.page.editing.unsaved import choose_unsaved
from tests.page.editing.harness import TEXT, EditorHarness
from tests.page.editing.kill_autosaves import run
from tests.playing import played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow


@pytest.fixture
def saver(tmp_path: Path) -> Autosave:
    return Autosave(tmp_path / "deep" / "unsaved", "small/../scene")


@pytest.fixture
def written(monkeypatch: pytest.MonkeyPatch) -> Semaphore:
    """Released after each write; without the usual delay before it."""
    done, write = Semaphore(0), autosave._write_file

    def tell(file: Path, state: EditState, order: tuple[int, int]) -> None:
        write(file, state, order)
        done.release()

    monkeypatch.setattr(autosave, "WRITE_DELAY_S", 0.0)
    monkeypatch.setattr(autosave, "_write_file", tell)
    return done


def test_a_changed_scene_is_written_and_read(saver: Autosave, tmp_path: Path) -> None:
    harness = EditorHarness()
    harness.editor.listeners.append(saver.schedule)
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    harness.done(harness.editor.move_body("ball", 1, 3))
    saver.stop()
    assert harness.editor.is_as_opened is False
    (file,) = (tmp_path / "deep" / "unsaved").iterdir()
    assert re.fullmatch(r"small-[0-9a-f]{12}-1\.unsaved", file.name)
    left = latest(file.parent)
    assert left is not None
    assert left.scene() == harness.editor.scene
    assert left.name == "small"
    assert len(left.when) == 5


def test_undone_changes_are_not_offered_for_recovery(tmp_path: Path) -> None:
    harness, saver = EditorHarness(), Autosave(tmp_path, "small")
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    harness.done(harness.editor.open(Scene.load("sumo")))
    saver.stop()
    left = latest(tmp_path)  # of a scene that is only looked at nothing is lost
    assert left is not None
    assert "ball" in left.text


def test_undo_deletes_the_autosave_file(tmp_path: Path, written: Semaphore) -> None:
    harness, saver = EditorHarness(), Autosave(tmp_path, "small")
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    assert written.acquire(timeout=LIMIT_S)
    harness.done(harness.editor.open(Scene.load("sumo")))
    harness.done(harness.editor.undo())
    harness.done(harness.editor.undo())
    saver.stop()
    assert list(tmp_path.iterdir()) == []


def test_each_scene_that_was_changed_is_kept(tmp_path: Path) -> None:
    harness, saver = EditorHarness(), Autosave(tmp_path, "small")
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    harness.done(harness.editor.open(Scene.load("sumo")))
    harness.done(harness.editor.add_body({"name": "pole", "position": [0, 3]}))
    saver.stop()
    assert {each.name: "ball" in each.text for each in unsaved_scenes(tmp_path)} == {
        "small": True,
        "sumo": False,
    }
    harness.editor.recovery.autosave = saver = Autosave(tmp_path, "small")
    harness.editor.recovery.mark_saved(harness.editor.scene)  # the one that runs was saved
    saver.stop()
    assert {each.name for each in unsaved_scenes(tmp_path)} == {"small", "sumo"}


def test_two_servers_on_one_scene_leave_each_other_s_work_alone(
    tmp_path: Path, written: Semaphore
) -> None:
    harnesses = [EditorHarness(), EditorHarness()]
    savers = [Autosave(tmp_path, "small") for _ in harnesses]
    for number, (harness, saver) in enumerate(zip(harnesses, savers, strict=True)):
        harness.editor.recovery.autosave = saver
        harness.done(harness.editor.add_body({"name": f"ball {number}", "position": [0, 3]}))
        assert written.acquire(timeout=LIMIT_S)
    assert len(list(tmp_path.glob("*.unsaved"))) == 2
    assert latest(tmp_path) is None, "the work of a server that lives is not offered"
    harnesses[1].done(harnesses[1].editor.undo())
    savers[1].stop()
    assert latest(tmp_path) is None
    savers[0].stop()
    (kept,) = unsaved_scenes(tmp_path)
    assert "ball 0" in kept.text


def test_a_restored_scene_is_kept_until_it_is_saved(tmp_path: Path) -> None:
    harness, saver = EditorHarness(), Autosave(tmp_path, "small")
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    saver.stop()
    left = latest(tmp_path)
    assert left is not None
    # as play --restore does; then it is changed, and the change is taken back
    again, saver = EditorHarness(left.scene()), Autosave(tmp_path, "small")
    again.editor.recovery.autosave = saver
    again.editor.recovery.mark_restored(left)
    assert latest(tmp_path) is None, "it has an owner again"
    again.done(again.editor.remove_body("wall"))
    again.done(again.editor.undo())
    saver.stop()
    (kept,) = unsaved_scenes(tmp_path)
    assert kept.scene() == left.scene()
    third, saver = EditorHarness(), Autosave(tmp_path, "small")
    third.editor.recovery.autosave, third.editor.recovery.unsaved = saver, kept
    third.done(third.editor.recovery.restore())
    third.editor.recovery.mark_saved(third.editor.scene)
    saver.stop()
    assert list(tmp_path.iterdir()) == []


def test_of_two_servers_that_restore_one_scene_both_keep_it(tmp_path: Path) -> None:
    left_by_an_earlier_version(tmp_path, "small", TEXT)
    left = latest(tmp_path)
    assert left is not None
    savers = [Autosave(tmp_path, "small") for _ in range(2)]
    for saver in savers:
        harness = EditorHarness(left.scene())
        harness.editor.recovery.autosave = saver
        harness.editor.recovery.mark_restored(left)
    for saver in savers:
        saver.stop()
    assert [each.text for each in unsaved_scenes(tmp_path)] == [EditorHarness().editor.text(), TEXT]


NOW = time.time()  # real time: files have the date of today; their ages count from here


def left_by_an_earlier_version(folder: Path, name: str, text: str, ago_s: float = 0.0) -> None:
    data = {"text": text, "folder": "", "saved_at": NOW - ago_s}
    (folder / f"{name}.unsaved").write_text(json.dumps(data))


def test_the_latest_is_found_after_the_clock_was_set_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    left_by_an_earlier_version(tmp_path, "small", "the oldest", ago_s=-3e7)
    for name, ahead_s in (("first", 1e7), ("second", 0.0), ("third", -1e7)):
        monkeypatch.setattr(time, "time", lambda ahead_s=ahead_s: NOW + ahead_s)
        harness, saver = EditorHarness(), Autosave(tmp_path, "small")
        harness.editor.recovery.autosave = saver
        harness.done(harness.editor.add_body({"name": name, "position": [0, 3]}))
        saver.stop()
    left = [each.text for each in unsaved_scenes(tmp_path)]
    assert left.pop() == "the oldest"
    assert ["third" in left[0], "second" in left[1], "first" in left[2]] == [True] * 3


def test_one_is_chosen_by_scene_or_number(tmp_path: Path) -> None:
    for number, name in enumerate(["small", "sumo", "box_chase", "box_chase 2"]):
        left_by_an_earlier_version(tmp_path, name, TEXT, ago_s=60.0 * number)
    left = unsaved_scenes(tmp_path)
    assert [each.name for each in left] == ["small", "sumo", "box_chase", "box_chase 2"]
    assert choose_unsaved(left) is left[0]
    assert choose_unsaved(left, "sumo") is left[1]
    assert choose_unsaved(left, "3") is left[2]
    assert choose_unsaved(left, str(tmp_path / "sumo.yaml")) is left[1]
    for wrong in ("maze", "0", "5", "99999999999", "\u00b2", "a\0b"):
        with pytest.raises(SetupError, match=r"there are 1 small \(.*\), 2 sumo \("):
            choose_unsaved(left, wrong)


def test_old_ones_go_but_never_the_latest_of_a_scene(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unsaved, "MAX_LEFT", 3)
    month = 40 * 24 * 3600.0
    for name, ago_s in (("aa", 0), ("bb", month), ("cc", month), ("dd", 2)):
        left_by_an_earlier_version(tmp_path, name, TEXT, ago_s=ago_s)
    for number in range(5):
        data = {"scene": "bb", "text": TEXT, "folder": "", "saved_at": NOW - 10 - number}
        (tmp_path / f"bb-0123456789a{number}-1.unsaved").write_text(json.dumps(data))
    (tmp_path / "0123456789a0.lock").touch()
    (tmp_path / "package.lock").touch()
    Autosave(tmp_path, "small").stop()
    names = sorted(path.name for path in tmp_path.iterdir())
    kept = ["aa.unsaved", "bb-0123456789a0-1.unsaved", "cc.unsaved", "dd.unsaved"]
    assert names == [*kept, "package.lock"]


def test_it_is_brought_back_or_forgotten(tmp_path: Path) -> None:
    left, saver = EditorHarness(), Autosave(tmp_path, "small")
    left.editor.recovery.autosave = saver
    left.done(left.editor.add_body({"name": "ball", "position": [0, 3]}))
    saver.stop()
    harness = EditorHarness()
    harness.editor.recovery.unsaved = latest(tmp_path)
    harness.done(harness.editor.recovery.restore())
    assert harness.editor.scene == left.editor.scene
    assert harness.editor.recovery.unsaved is None
    harness.done(harness.editor.undo())
    assert "ball" not in harness.world.bodies
    harness.editor.recovery.autosave = saver = Autosave(tmp_path, "small")
    harness.editor.recovery.mark_saved(harness.editor.scene)
    saver.stop()
    assert latest(tmp_path) is None
    with pytest.raises(SetupError, match="there is no unsaved scene"):
        harness.done(harness.editor.recovery.restore())


def test_many_changes_are_written_once(saver: Autosave, monkeypatch: pytest.MonkeyPatch) -> None:
    written = []
    monkeypatch.setattr(autosave, "_write_file", lambda _file, state, _order: written.append(state))
    # the pause after the last change does not come before the end
    monkeypatch.setattr(autosave, "WRITE_DELAY_S", LIMIT_S)
    monkeypatch.setattr(autosave, "MAX_WRITE_DELAY_S", LIMIT_S)
    state = EditorHarness().editor.state
    for number in range(100):
        state = state.describing(title=str(number))
        saver.schedule(state)
    saver.stop()
    assert [each.description.title for each in written] == ["99"]


def test_malformed_autosave_files_are_ignored(tmp_path: Path) -> None:
    for name, text in (("a", "{"), ("b", "[]"), ("c", '{"text": "x"}'), ("d", "\0")):
        (tmp_path / f"{name}.unsaved").write_text(text)
    assert latest(tmp_path) is None
    assert latest(tmp_path / "nowhere") is None


@pytest.mark.parametrize("where", ["file", "file/deeper", "/proc/self", "/dev/null"])
def test_a_folder_that_can_t_be_made_is_told_of_once(tmp_path: Path, where: str) -> None:
    (tmp_path / "file").touch()
    told: list[str] = []
    saver = Autosave(tmp_path / where / "unsaved", "small", told.append)
    assert told == [saver.problem]
    assert told[0].startswith("changes can't be kept in ")
    harness = EditorHarness()
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    saver.stop()
    assert told == [saver.problem]
    assert unsaved_scenes(tmp_path / where / "unsaved") == []


def test_a_full_disk_is_told_of_once_and_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(autosave, "WRITE_DELAY_S", 0.0)
    monkeypatch.setattr(autosave, "RETRY_S", 0.01)
    tries, is_written, write = Semaphore(0), Event(), autosave._write_file
    is_full = [True]

    def written(file: Path, state: EditState, order: tuple[int, int]) -> None:
        tries.release()
        if is_full[0]:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(file, state, order)
        is_written.set()

    monkeypatch.setattr(autosave, "_write_file", written)
    told: list[str] = []
    harness, saver = EditorHarness(), Autosave(tmp_path, "small", told.append)
    harness.editor.recovery.autosave = saver
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    for _ in range(3):
        assert tries.acquire(timeout=LIMIT_S)
    assert told == [f"changes can't be kept in {tmp_path}: the disk is full"]
    assert latest(tmp_path) is None
    is_full[0] = False
    assert is_written.wait(LIMIT_S)
    saver.stop()
    assert len(told) == 1
    assert saver.problem == ""
    assert len(unsaved_scenes(tmp_path)) == 1


def test_a_name_that_is_too_long_for_a_file_is_cut(tmp_path: Path) -> None:
    harness, saver = EditorHarness(), Autosave(tmp_path, "\u4e00" * 80)
    saver.schedule(harness.editor.state.describing(name="\u4e00" * 80))
    saver.stop()
    assert len(unsaved_scenes(tmp_path)) == 1


def test_a_killed_server_leaves_it_whole() -> None:
    assert run(2) == []


def test_the_command_line_restores(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "ai4u_edu", "play", "--restore", "--no-open"]
    environment = {**os.environ, "XDG_STATE_HOME": str(tmp_path)}
    told = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert told.returncode == 1
    assert told.stderr == "error: there is no unsaved scene; expected: ai4u-edu play SCENE\n"


def test_a_state_folder_that_can_t_be_made_is_no_reason_not_to_start(tmp_path: Path) -> None:
    (tmp_path / "state").touch()
    with played("box_chase", state=tmp_path / "state") as server:
        assert server.snapshot()["agents"]
    told = "".join(server.told)
    assert f"warning: changes can't be kept in {tmp_path}/state/ai4u-edu/unsaved: Not a" in told
    assert "Traceback" not in told


def test_restore_takes_the_scene_that_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    folder = autosave.unsaved_folder()
    folder.mkdir(parents=True)
    for ago_s, name in enumerate(["sumo", "tag", "tag"]):
        text = Scene.load(name).dumps()
        left_by_an_earlier_version(folder, f"{name}-0123456789a{ago_s}-1", text, ago_s=60 * ago_s)
    with played("tag", "--restore", state=tmp_path) as server:
        assert len(server.snapshot()["agents"]) == len(Scene.load("tag").description.agents)
        until(lambda: [each.name for each in unsaved_scenes(folder)] == ["sumo", "tag"])
        with played("2", "--restore", state=tmp_path) as other:
            until(lambda: "unsaved scenes: 1 sumo (" in "".join(other.told))
            until(lambda: [each.name for each in unsaved_scenes(folder)] == ["sumo"])


@pytest.mark.parametrize("option", ["--record", "--scenes"])
def test_a_folder_that_was_asked_for_has_to_be_one(tmp_path: Path, option: str) -> None:
    (tmp_path / "file").touch()
    command = [sys.executable, "-m", "ai4u_edu", "play", option, str(tmp_path / "file")]
    told = subprocess.run(
        [*command, "--no-open", "--no-autosave"], capture_output=True, text=True, check=False
    )
    assert told.returncode == 1
    assert re.fullmatch(
        rf"error: {tmp_path}/file: expected a folder for .*: File exists; choose another one\n",
        told.stderr,
    )


def test_nothing_is_kept_unless_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    harness = EditorHarness(Scene.load("box_chase"))
    assert isinstance(harness.editor, SceneEditor)
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    assert list(tmp_path.iterdir()) == []
