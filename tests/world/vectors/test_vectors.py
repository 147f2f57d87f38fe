"""Recorded calls give the same bits on every system whose programs can be run here."""

import os
from pathlib import Path

import pytest

from ai4u_edu.world.native.segments import compiled_cast
from tests.world.vectors.targets import TARGETS, missing_tools, replay

pytestmark = [
    pytest.mark.skipif(os.name != "posix", reason="the wheel's tests run there themselves"),
    pytest.mark.skipif(compiled_cast() is None, reason="nothing is compiled here"),
]
OTHERS = [pytest.param(name, marks=pytest.mark.nightly) for name in list(TARGETS)[1:]]


@pytest.mark.parametrize("name", [next(iter(TARGETS)), *OTHERS])
def test_recorded_calls_give_the_same_bits(name: str, tmp_path: Path) -> None:
    missing = missing_tools(name)
    if missing:
        pytest.skip(f"{', '.join(missing)} is not here")
    assert replay(name, tmp_path) == (True, "192 calls, the same bits")


def test_other_bits_are_noticed(tmp_path: Path) -> None:
    name = next(iter(TARGETS))
    if missing_tools(name):
        pytest.skip("no C compiler here")
    replay(name, tmp_path)
    vectors = tmp_path / "vectors.bin"
    content = bytearray(vectors.read_bytes())
    content[-16] ^= 1  # what the last call returned
    vectors.write_bytes(content)
    has_same_bits, text = replay(name, tmp_path)
    assert not has_same_bits
    assert "returned something else" in text
