"""Drives in the scenes of the library stay the same, bit for bit, from commit to commit."""

import hashlib
import math
import os
import random
import struct
import subprocess
import sys
import sysconfig
from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu.recording import Episode, Replay
from tests.recording.kept import FOLDER, KEPT, path_of, record

ROOT = Path(__file__).parents[2]
KEPT_SINES = "57d85461b8de22a3"
"""Digest of sines and the like by the C library and the processor of the recordings."""


def sines() -> str:
    """Return a digest of sines, cosines and exponentials of drawn numbers.

    C libraries differ in their last bits, and so does one of them on a processor without FMA.
    """
    draw = random.Random(1)
    numbers = [
        function(draw.uniform(-4.0, 4.0))
        for function in (math.sin, math.cos, math.exp)
        for _ in range(10_000)
    ]
    return hashlib.sha256(struct.pack(f"<{len(numbers)}d", *numbers)).hexdigest()[:16]


pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        sys.platform != "linux" or "x86_64" not in sysconfig.get_platform(),
        reason="the drives were recorded on Linux, x86-64",
    ),
    pytest.mark.skipif(
        sines() != KEPT_SINES, reason="sines are not those of the machine of the recordings"
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


def test_a_drive_does_not_depend_on_the_kernels_of_matrices() -> None:
    # numpy's library for them takes others, whose sums have other last bits, on each processor
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", __file__, "-k", "recorded_again"],
        cwd=ROOT,
        env={**os.environ, "OPENBLAS_CORETYPE": "Prescott"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout
