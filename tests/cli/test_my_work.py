"""A student's work from a class, which anybody may have made."""

import struct
import zipfile
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.member import my_work as module
from ai4u_edu.member.my_work import UnsafeSceneError, open_my_work
from tests.playing import played

LIBRARY = Path(__file__).parents[2] / "ai4u_edu/scenes/library"
SCENE = (LIBRARY / "box_chase.yaml").read_text(encoding="utf-8")


def zipped(file: Path, **more: str | bytes) -> Path:
    """Write a student's work, and more files, with ``__`` for a slash and ``_dot_`` for a dot."""
    named = {name.replace("__", "/").replace("_dot_", "."): data for name, data in more.items()}
    return packed(file, {"scene.yaml": SCENE, **named})


def packed(file: Path, entries: dict[str, str | bytes]) -> Path:
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    return file


def contents(folder: Path) -> list[str]:
    return sorted(str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file())


def test_known_files_are_unpacked_and_others_ignored(tmp_path: Path) -> None:
    entries: dict[str, str | bytes] = {
        "scene.yaml": SCENE,
        "scenes/Mi laberinto.yaml": SCENE,
        "episodes/box_chase-7-goal.episode": b"1",
        "progress.json": "{}",
        "../evil.yaml": SCENE,
        "scenes/../../evil.yaml": SCENE,
        "scenes/..yaml": SCENE,
        "scenes/deep/er.yaml": SCENE,
        "scenes/con.yaml": SCENE,
        "scenes\\evil.yaml": SCENE,
        "/etc/evil.yaml": SCENE,
        "C:evil.yaml": SCENE,
        "episodes/.hidden.episode": b"1",
        "episodes/evil.py": "1",
        "blocks.py": "1",
        "Scene.YAML": "another name on some systems",
    }
    work = open_my_work(packed(tmp_path / "my-work.zip", entries))
    assert work.folder == tmp_path / "my-work"
    assert contents(work.folder) == [
        ".my-work",
        "episodes/box_chase-7-goal.episode",
        "progress.json",
        "scene.yaml",
        "scenes/Mi laberinto.yaml",
    ]
    assert sorted(each.name for each in tmp_path.iterdir()) == ["my-work", "my-work.zip"]


def test_what_was_changed_since_stays_and_another_file_gets_another_folder(tmp_path: Path) -> None:
    file = zipped(tmp_path / "my-work.zip")
    work = open_my_work(file)
    work.scene.write_text("changed", encoding="utf-8")
    assert open_my_work(file) == work
    assert work.scene.read_text(encoding="utf-8") == "changed"
    zipped(file, progress_dot_json="{}")
    other = open_my_work(file)
    assert other.folder == tmp_path / "my-work-2"
    assert other.scene.read_text(encoding="utf-8") == SCENE


@pytest.mark.parametrize(
    ("limit", "told"),
    [("MAX_SCENE_BYTES", "scene.yaml is too large"), ("MAX_TOTAL_BYTES", "too large")],
)
def test_a_small_file_that_becomes_a_large_one_is_refused(
    limit: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, limit, 100_000)
    file = packed(tmp_path / "my-work.zip", {"scene.yaml": "#" * 200_000})
    assert file.stat().st_size < 2000
    data = file.read_bytes()  # and says that it is a small one
    file.write_bytes(data.replace(struct.pack("<L", 200_000), struct.pack("<L", 10)))
    with pytest.raises(SetupError, match=rf"{told}|expected the ZIP file"):
        open_my_work(file)
    file.write_bytes(data)
    with pytest.raises(SetupError, match=told):
        open_my_work(file)
    assert [each.name for each in tmp_path.iterdir()] == ["my-work.zip"]


def test_files_that_are_no_work_are_sentences(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "my-work.zip"
    with pytest.raises(SetupError, match="No such file"):
        open_my_work(file)
    file.write_bytes(b"PK no zip")
    with pytest.raises(SetupError, match="expected the ZIP file that a class gave"):
        open_my_work(file)
    packed(file, {"notes.txt": "1"})
    with pytest.raises(SetupError, match=r"there is no scene\.yaml in it"):
        open_my_work(file)
    whole = zipped(file).read_bytes()
    file.write_bytes(whole[:60] + b"\x00\xff" * 20 + whole[100:])
    with pytest.raises(SetupError, match="expected the ZIP file that a class gave"):
        open_my_work(file)
    monkeypatch.setattr(module, "MAX_ZIP_BYTES", 10)
    with pytest.raises(SetupError, match="expected at most"):
        open_my_work(file)


@pytest.mark.parametrize("reference", ["host: 10.0.0.1", "model_path: ../../secret.onnx"])
def test_a_scene_may_name_no_other_machine_and_no_file_elsewhere(
    reference: str, tmp_path: Path
) -> None:
    text = f"name: x\nagents:\n  - brain: {{{reference}}}\n"
    file = zipped(tmp_path / "my-work.zip", scenes__other_dot_yaml=text)
    with pytest.raises(UnsafeSceneError, match=r"my-work\.zip: scenes/other\.yaml: "):
        open_my_work(file)
    assert not (tmp_path / "my-work").exists()


@pytest.mark.slow
def test_play_serves_it(tmp_path: Path) -> None:
    file = zipped(tmp_path / "my-work.zip", scenes__mine_dot_yaml=SCENE)
    with played(str(file)) as room:
        assert {each["name"] for each in room.snapshot()["bodies"]} == {"robot", "box"}
        assert f"Your work is in {tmp_path / 'my-work'}" in "".join(room.told)
