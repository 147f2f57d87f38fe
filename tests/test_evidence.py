"""A failed test leaves files that say what happened; these stories fail on purpose."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.tiers import ROOT

pytestmark = pytest.mark.slow

WITH_PAGE = """
from tests.browser.conftest import chromium
from tests.chromium import new_page
from tests.playing import played

def test_story(chromium):
    with played("box_chase") as server:
        page = new_page(chromium)
        page.goto(server.url + "healthz")
        page.evaluate("console.log('here I am')")
        assert page.title() == "another one"
"""
WITH_PROCESS = """
from tests.playing import played

def test_story():
    with played("box_chase") as server:
        assert server.snapshot()["seed"] == "none"
"""
WITH_MESSAGES = """
from tests.page.server.rooms import served

def test_story():
    with served() as room, room.page() as page:
        page.send("nonsense")
        page.receive("error")
        assert room.held == ["KeyW"]
"""
WITH_TEST_BEFORE = """
def test_before():
    pass

def test_story():
    assert False
"""
WITH_ERROR_IN_FIXTURE = """
import logging
import pytest

@pytest.fixture
def broken():
    logging.getLogger("ai4u_edu").error("it is broken")
    raise OSError

def test_story(broken):
    pass
"""


def failed(tmp_path: Path, story: str) -> dict[str, bytes]:
    """Run a story that fails; return the files that are kept of it, by their names."""
    file, results = tmp_path / "test_story.py", tmp_path / "results"
    file.write_text(story, encoding="utf-8")
    conftest = f"--confcutdir={ROOT} -p tests.conftest -c {ROOT / 'pyproject.toml'}".split()
    command = [sys.executable, "-m", "pytest", *conftest, "-n0", f"--results={results}", str(file)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 1, done.stdout
    (folder,) = (results / "failures").iterdir()
    assert str(folder) in done.stdout
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.browser
def test_of_a_page_its_picture_and_console_are_kept(tmp_path: Path) -> None:
    files = failed(tmp_path, WITH_PAGE)
    assert files["page.png"].startswith(b"\x89PNG")
    assert b"log: here I am" in files["page.txt"]
    assert b"http://127.0.0.1" in files["play.log"]
    assert b"another one" in files["call.txt"]


def test_of_a_served_process_its_output_is_kept(tmp_path: Path) -> None:
    files = failed(tmp_path, WITH_PROCESS)
    assert b"http://127.0.0.1" in files["play.log"]
    assert b'["seed"] == "none"' in files["call.txt"]


def test_of_a_client_its_last_messages_are_kept(tmp_path: Path) -> None:
    files = failed(tmp_path, WITH_MESSAGES)
    assert b'> {"type": "nonsense"}' in files["socket.txt"]
    assert b'< {"type": "error"' in files["socket.txt"]


def test_of_an_error_in_a_fixture_its_log_is_kept(tmp_path: Path) -> None:
    assert b"it is broken" in failed(tmp_path, WITH_ERROR_IN_FIXTURE)["setup.txt"]


def test_the_tests_that_the_process_had_run_before_are_named(tmp_path: Path) -> None:
    assert failed(tmp_path, WITH_TEST_BEFORE)["tests-before.txt"].endswith(b"::test_before")
