"""The bundle for machines without internet; nightly it is made, and started without a network."""

import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli import bundle
from tests.waiting import LIMIT_S

ROOT = Path(__file__).parents[2]
THIS = f"{sys.platform} {sys.version_info[0]}.{sys.version_info[1]}"
PLAY = f"""
import subprocess, sys, urllib.request
command = [*sys.argv[1:], "play", "--port", "0", "--no-open", "--no-wait-for-key"]
pipes = dict(stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
with subprocess.Popen(command, text=True, **pipes) as process:
    url = next(word for line in process.stdout for word in line.split() if word.startswith("http"))
    page = urllib.request.urlopen(url, timeout={LIMIT_S}).read()
    process.terminate()
print("page", b"<html" in page.lower())
"""


def test_scripts_are_written_for_each_system(tmp_path: Path) -> None:
    bundle.write_scripts(tmp_path, [])
    assert json.loads((tmp_path / "bundle.json").read_text())["made_on"] == [THIS]
    version = THIS.split()[1]
    for name in ("start.sh", "start.command", "start.bat", "README.txt"):
        content = (tmp_path / name).read_bytes()
        assert version.encode() in content
        assert b"VERSIONS" not in content
        assert (b"\r\n" in content) == name.endswith(".bat")
    if os.name == "posix":
        assert os.access(tmp_path / "start.sh", os.X_OK)
        assert not os.access(tmp_path / "start.py", os.X_OK)


@pytest.mark.skipif(os.name != "posix", reason="start.bat is for Windows")
@pytest.mark.parametrize("script", ["start.sh", "start.command"])
def test_a_python_that_can_not_run_is_passed_over(tmp_path: Path, script: str) -> None:
    bundle.write_scripts(tmp_path, [])
    (tmp_path / "start.py").write_text("import sys; print('started', *sys.argv[1:])")
    stubs = tmp_path / "stubs"
    stubs.mkdir()

    def stub(name: str, text: str) -> None:
        (stubs / name).write_text(f"#!/bin/sh\n{text}\n")
        (stubs / name).chmod(0o755)

    def start() -> subprocess.CompletedProcess[str]:
        paths = {"PATH": f"{stubs}:/usr/bin:/bin"}
        command: list[str | Path] = ["sh", tmp_path / script, "play", "a b"]
        return subprocess.run(command, env=paths, capture_output=True, text=True, check=False)

    # as a version manager's, of a version that is not chosen
    for name in (f"python{THIS.split()[1]}", "python3"):
        stub(name, "echo 'command not found' >&2; exit 127")
    done = start()
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("Expected Python (")
    stub("python3", f'exec "{sys.executable}" "$@"')
    assert start().stdout == "started play a b\n"


def test_a_bundle_of_another_system_is_added_to(tmp_path: Path) -> None:
    older = {"made_on": ["win32 3.9"], "extras": ["video"]}
    (tmp_path / "bundle.json").write_text(json.dumps(older))
    assert bundle.write_scripts(tmp_path, ["multi"]) == ["3.9", THIS.split()[1]]
    made = json.loads((tmp_path / "bundle.json").read_text())
    assert made["made_on"] == sorted([THIS, "win32 3.9"])
    assert made["extras"] == ["multi", "video"]


def test_another_python_is_told_what_it_needs(tmp_path: Path) -> None:
    bundle.write_scripts(tmp_path, [])
    (tmp_path / "bundle.json").write_text(json.dumps({"made_on": ["win32 3.9"], "extras": []}))
    command: list[str | Path] = [sys.executable, tmp_path / "start.py"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "(win32 3.9)" in done.stderr
    assert THIS in done.stderr


def test_course_and_scenes_can_be_changed_and_stay(tmp_path: Path) -> None:
    bundle.write_scenes(tmp_path)
    changed = tmp_path / "maze.yaml"
    changed.write_text("mine")
    bundle.write_scenes(tmp_path)
    assert changed.read_text() == "mine"
    assert (tmp_path / "box_chase.yaml").read_bytes()


def test_an_unknown_extra_is_told(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match=r"expected one of lessons, .* got 'all'"):
        bundle.bundle(tmp_path, extra=["all"])


def test_every_extra_for_users_is_offered_and_in_the_docs() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = {*project["optional-dependencies"]} - {"dev", "docs", "fuzz", "test"}
    assert {*bundle.EXTRAS} == extras
    page = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    assert {name for name in extras if f"| `{name}` |" not in page} == set()


@pytest.mark.nightly
@pytest.mark.skipif(shutil.which("unshare") is None, reason="switches the network off with unshare")
def test_it_starts_without_a_network(tmp_path: Path) -> None:
    made = tmp_path / "bundle"
    subprocess.run([sys.executable, "-m", "ai4u_edu", "bundle", made], check=True)
    alone = [
        "unshare",
        "--map-root-user",
        "--net",
        "sh",
        "-c",
        'ip link set lo up && exec "$@"',
        "-",
    ]
    command: list[str | Path] = [*alone, sys.executable, "-c", PLAY, "sh", made / "start.sh"]
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path)}
    done = subprocess.run(
        command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.stdout == "page True\n", done.stderr
    assert list((made / "course").glob("*.ipynb"))
