"""A person's drives on the disk, and what an agent can learn from them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.agent import BasicAgent
from ai4u_edu.recording import Episode
from ai4u_edu.recording.agent_record import PERSON
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.teach import drives
from ai4u_edu.teach.drives import Drive, DriveFolder
from tests.teach.driving import drive


@pytest.fixture(scope="module")
def driven() -> Episode:
    return drive(1)


def here(scene: Scene) -> tuple[BasicAgent, SceneDescription]:
    """Return the agent and the description of a scene that runs."""
    sim = scene.build()
    sim.reset(0)
    return sim.agents[0], export_scene(sim, scene.description)


def reason(episode: Episode, scene: Scene) -> str:
    return Drive(1, episode).reason_against(*here(scene))


def changed(scene: str, before: str, after: str) -> Scene:
    text = Scene.load(scene).dumps()
    assert before in text
    return Scene.loads(text.replace(before, after))


def test_a_whole_drive_of_the_same_scene_is_one_to_learn_from(driven: Episode) -> None:
    assert reason(driven, Scene.load("box_chase")) == ""
    assert driven.success


def test_the_same_scene_under_another_title_is_the_same(driven: Episode) -> None:
    other = changed("box_chase", "title: Box chase", "title: My own")
    assert reason(driven, other) == ""


def test_each_other_drive_has_its_reason(driven: Episode) -> None:
    scene = Scene.load("box_chase")
    assert reason(drive(1, decisions=4), scene) == drives.TOO_SHORT
    assert reason(replace(driven, changed=20), scene) == drives.CHANGED
    moved = changed("box_chase", "mass: 5", "mass: 6")
    assert reason(driven, moved) == drives.OTHER_SCENE
    blind = changed("box_chase", "rows: 3", "rows: 2")
    assert reason(driven, blind) == drives.OTHER_ROBOT
    few = driven.agents[0].flags & ~np.uint8(PERSON)
    few[:4] |= PERSON
    mixed = replace(driven, agents=(replace(driven.agents[0], flags=few),))
    assert reason(mixed, scene) == drives.TOO_SHORT


def test_a_drive_is_there_after_a_restart(driven: Episode, tmp_path: Path) -> None:
    DriveFolder(tmp_path).add(driven)
    (kept,) = DriveFolder(tmp_path).drives("box_chase")
    assert (kept.number, len(kept.episode.agents[0])) == (1, len(driven.agents[0]))


def test_the_oldest_drives_go_first(
    driven: Episode, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = DriveFolder(tmp_path)
    monkeypatch.setattr(drives, "MAX_DRIVES", 3)
    for _ in range(5):
        folder.add(driven)
    assert [each.number for each in folder.drives("box_chase")] == [3, 4, 5]
    monkeypatch.setattr(drives, "MAX_DECISIONS", len(driven.agents[0]))
    folder.add(driven)
    assert [each.number for each in folder.drives("box_chase")] == [6]


def test_drives_of_scenes_of_like_names_do_not_mix(driven: Episode, tmp_path: Path) -> None:
    folder = DriveFolder(tmp_path)
    for name in ("box", "box-1", "box_chase", "../box"):
        scene = driven.scene.model_copy(update={"name": name})
        folder.add(replace(driven, scene=scene))
    for name in ("box", "box-1", "box_chase", "../box"):
        assert len(folder.drives(name)) == 1
    assert {path.parent for path in tmp_path.rglob("*.episode")} == {tmp_path}


def test_a_file_that_is_no_drive_is_left_out(driven: Episode, tmp_path: Path) -> None:
    folder = DriveFolder(tmp_path)
    folder.add(driven)
    (tmp_path / "box_chase-7.episode").write_bytes(b"nonsense")
    assert [each.number for each in folder.drives("box_chase")] == [1]
    folder.add(driven)
    assert [each.number for each in folder.drives("box_chase")] == [1, 8]
