"""The compiled library is optional: it is used where it is there and fits, else left out."""

import os
import shutil
import sys
from pathlib import Path

import pytest

from ai4u_edu.world.native import compiled as _compiled

library = _compiled.load_library.__wrapped__
needs_library = pytest.mark.skipif(library() is None, reason="nothing is compiled here")


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the package's folder with all that belongs to the library."""
    for path in (_compiled.SOURCE, _compiled.SOURCE.with_name(_compiled.library_name(os.name))):
        if path.exists():
            shutil.copy(path, tmp_path)
    monkeypatch.setattr(_compiled, "SOURCE", tmp_path / "rays.c")
    return tmp_path


@needs_library
def test_it_is_loaded_from_the_package(package: Path) -> None:
    made = library()
    assert made is not None
    assert all(hasattr(made, name) for name in ("cast_fan", "look", "look_behind"))
    assert Path(made._name).parent == package


@pytest.mark.skipif(os.environ.get("AI4U_COMPILED") != "1", reason="it may be missing")
def test_it_is_there_where_it_has_to_be() -> None:
    """In a wheel for one platform; the wheels' builds set the variable."""
    assert library() is not None


@needs_library
def test_it_can_be_switched_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(_compiled.SWITCH_VARIABLE, "0")
    assert library() is None


def test_without_a_library_there_is_none_and_no_word(
    package: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (package / _compiled.library_name(os.name)).unlink(missing_ok=True)
    assert library() is None
    assert capfd.readouterr() == ("", "")
    assert [path.name for path in package.iterdir()] == ["rays.c"], "nothing is made"


def test_what_another_machine_made_is_left_out(package: Path) -> None:
    (package / _compiled.library_name(os.name)).write_bytes(b"for another processor")
    assert library() is None


@needs_library
def test_a_library_of_another_source_is_left_out(package: Path) -> None:
    with (package / "rays.c").open("a") as source:
        source.write("/* changed */\n")
    assert library() is None


def test_each_system_has_its_name() -> None:
    assert _compiled.library_name("nt").endswith(".dll")
    assert _compiled.library_name("posix").endswith(".so")
    assert _compiled.library_name(os.name) == _compiled.library_name(
        "nt" if sys.platform == "win32" else "posix"
    )
