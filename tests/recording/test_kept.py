"""Drives in the scenes of the library stay the same, bit for bit, from commit to commit."""

import sys
import sysconfig
from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu.recording import Episode, Replay
from tests.recording.kept import FOLDER, KEPT, path_of, record

pytestmark = [
    pytest.mark.slow,
    # C libraries differ in the last bit of a sine
    pytest.mark.skipif(
        sys.platform != "linux" or "x86_64" not in sysconfig.get_platform(),
        reason="the drives were recorded on Linux, x86-64",
    ),
]


def test_every_scene_is_kept() -> None:
    assert sorted(path.stem for path in FOLDER.glob("*.episode")) == sorted(KEPT)


@pytest.mark.parametrize("name", KEPT)
def test_a_kept_drive_replays_exactly(name: str) -> None:
    verdict = Replay(Episode.load(path_of(name))).verdict
    assert verdict.exact, verdict.why


@pytest.mark.parametrize("name", KEPT)
def test_a_drive_recorded_again_is_the_same_file(name: str, tmp_path: Path) -> None:
    # its brains decide here, in place of the file's actions
    kept, again = (
        replace(episode, versions={}).save(tmp_path / f"{index}.episode").read_bytes()
        for index, episode in enumerate((Episode.load(path_of(name)), record(name)))
    )
    assert again == kept
