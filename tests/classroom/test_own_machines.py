"""Students' own machines in a real class: a notebook and ``play --class``."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import psutil
import pytest
from typer.testing import CliRunner

from ai4u_edu.cli.main import app
from ai4u_edu.member import SeatFile
from ai4u_edu.member.joining import SEAT_COOKIE
from ai4u_edu.member.my_work import open_my_work
from ai4u_edu.scenes import Scene
from tests.classroom.link_client import TeacherSocket
from tests.classroom.reserved_port import reserved_port
from tests.classroom.served_class import CODE, ServedClass, served_class
from tests.lessons.kernel import kernel_config
from tests.page.server import http_client
from tests.playing import played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

BEGIN = """
from ai4u_edu.lessons import check, hint, join_class, leave_class, show, stop
def stay(percept): return {"move": [0, 0, 0, 0]}
def go(percept): return {"move": [1, 0, 0, 0]}
"""


class Kernel:
    """A Jupyter kernel, as a notebook has it.

    Args:
        folder: of the notebook.
        config: as of :func:`kernel_config`.
    """

    def __init__(self, folder: Path, config: Any) -> None:
        from jupyter_client.manager import KernelManager

        folder.mkdir(exist_ok=True)
        self.manager = KernelManager(kernel_name="python3", config=config)
        self.manager.start_kernel(cwd=str(folder))
        self._client = self.manager.client()
        self._client.start_channels()
        self._client.wait_for_ready(timeout=LIMIT_S)
        self.run(BEGIN)

    def run(self, cell: str) -> str:
        """Run a cell; return the text of its output."""
        told: list[str] = []

        def note(message: dict[str, Any]) -> None:
            content = message["content"]
            told.append(content.get("text") or content.get("data", {}).get("text/plain", ""))

        reply = self._client.execute_interactive(cell, output_hook=note, timeout=LIMIT_S)
        assert reply["content"]["status"] == "ok", reply["content"]
        return "".join(told)

    def kill(self) -> None:
        """End the kernel as a crash does."""
        self._client.stop_channels()
        self.manager.shutdown_kernel(now=True)


@contextmanager
def kernel(folder: Path) -> Iterator[Kernel]:
    with kernel_config() as config:
        notebook = Kernel(folder, config)
        try:
            yield notebook
        finally:
            notebook.kill()


@pytest.fixture(scope="module")
def there(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as there:
        yield there


def progress(teacher: TeacherSocket, fits: Any) -> dict[str, Any]:
    """Return the progress of the only seat that has any, as soon as it fits."""
    event = teacher.next("class", lambda e: any(map(fits, e["progress"].values())))
    found: dict[str, Any] = next(filter(fits, event["progress"].values()))
    return found


def name_in(told: str) -> str:
    return told.partition("You are ")[2].partition(".")[0]


def test_a_notebook_reports_its_checks_and_shows_its_world(
    there: ServedClass, tmp_path: Path
) -> None:
    with kernel(tmp_path / "lessons") as notebook, TeacherSocket(there) as teacher:
        name = name_in(notebook.run(f"join_class({there.url!r}, {CODE!r})"))
        notebook.run('check("00.1", stay)')
        tried = progress(teacher, lambda p: p.get("00.1", {}).get("state") == "tried")
        assert tried["00.1"]["tries"] == 1
        notebook.run('hint("00.1")')
        progress(teacher, lambda p: p["00.1"]["state"] == "hint")
        notebook.run('check("00.1", go)')
        solved = progress(teacher, lambda p: p["00.1"]["state"] == "solved")
        assert solved["00.1"]["tries"] == 2

        notebook.run('show("box_chase")')

        def own_rooms(event: dict[str, Any]) -> list[dict[str, Any]]:
            seats = [[seat["number"]] for seat in event["seats"] if seat["name"] == name]
            rooms = [room for room in event["rooms"] if room["seats"] in seats]
            return [
                room for room in rooms if (room["scene"], room["kind"]) == ("Box chase", "remote")
            ]

        (room,) = own_rooms(teacher.next("class", own_rooms))
        drawing = teacher.next("drawing", lambda e: e["room"] == room["id"])
        assert {each["name"] for each in drawing["bodies"]} == {"robot", "box"}

    with kernel(tmp_path / "lessons") as restarted:
        assert name_in(restarted.run(f"join_class({there.url!r}, 'forgotten')")) == name


@pytest.mark.nightly
def test_a_notebook_hands_in_a_network_and_hears_the_verdict(
    there: ServedClass, tmp_path: Path
) -> None:
    with kernel(tmp_path / "lessons") as notebook:
        notebook.run("from ai4u_edu.blocks.brains import zoo; from ai4u_edu.lessons import submit")
        assert "You are in no class." in notebook.run('submit("maze", zoo.network_of("maze"))')
        notebook.run(f"join_class({there.url!r}, {CODE!r})")
        told = notebook.run('submit("maze", zoo.network_of("maze"))')
        assert "Handed in. maze.onnx for maze can play in the tournament." in told
        told = notebook.run('submit("sumo", zoo.network_of("maze"))')
        assert "Not taken. maze.onnx for sumo: " in told


@pytest.mark.nightly
@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSTOP")
def test_a_network_that_is_gone_for_a_minute_loses_no_result(tmp_path: Path) -> None:
    """The class answers nothing for a minute, and no connection is closed: as without Wi-Fi."""
    with served_class(tmp_path / "class") as there, kernel(tmp_path / "lessons") as notebook:
        notebook.run(f"join_class({there.url!r}, {CODE!r})")
        notebook.run('check("00.1", stay)')
        with TeacherSocket(there) as teacher:
            progress(teacher, lambda p: p["00.1"]["tries"] == 1)
        process = psutil.Process(there.process.pid)
        process.suspend()
        time.sleep(60)  # real time: the minute itself, which may also be longer
        count = 2 + checks_until_results_are_kept(notebook)
        notebook.run('check("00.1", go)')
        process.resume()
        with TeacherSocket(there) as teacher:
            solved = progress(teacher, lambda p: p["00.1"]["state"] == "solved")
        assert solved["00.1"]["tries"] == count


def checks_until_results_are_kept(notebook: Kernel) -> int:
    """Check until the notebook has noticed that the class is gone; return how often."""
    count = 0

    def are_kept() -> bool:
        nonlocal count
        count += 1
        return "Results are kept and sent later." in notebook.run('check("00.1", stay)')

    until(are_kept)
    return count


def test_results_survive_a_class_that_is_killed_and_a_kernel_that_is_killed(
    tmp_path: Path,
) -> None:
    lessons, folder = tmp_path / "lessons", tmp_path / "class"
    with reserved_port() as port, served_class(folder, "--port", str(port)) as there:
        with kernel(lessons) as notebook:
            notebook.run(f"join_class({there.url!r}, {CODE!r})")
            notebook.run('check("00.1", stay)')
            with TeacherSocket(there) as teacher:
                progress(teacher, lambda p: p["00.1"]["tries"] == 1)
            there.process.kill()
            there.process.wait()
            count = 1 + checks_until_results_are_kept(notebook)
        # the kernel is killed, too, and the next one delivers what it left
        with served_class(folder, "--port", str(port)) as again, kernel(lessons) as notebook:
            assert again.url == there.url
            notebook.run(f"join_class({again.url!r}, {CODE!r})")
            with TeacherSocket(again) as teacher:
                progress(teacher, lambda p: p["00.1"]["tries"] == count)
                notebook.run('check("00.1", go)')
                solved = progress(teacher, lambda p: p["00.1"]["state"] == "solved")
            assert solved["00.1"]["tries"] == count + 1


def test_a_world_on_another_machine_joins_and_keeps_its_seat(
    there: ServedClass, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA", "HOME"):
        monkeypatch.setenv(name, str(tmp_path))
    command = ("box_chase", "--class", there.url)
    # after a restart, the code is not needed any more
    first = play_and_be_seen(there, *command, "--code", CODE)
    assert play_and_be_seen(there, *command) == first

    (seat,) = SeatFile(tmp_path / "ai4u-edu/classes/seats.json").seats().values()
    cookies = {SEAT_COOKIE: seat.token}
    answer = http_client.get(f"{there.url}api/my-work", cookies=cookies)
    assert answer.status_code == 200
    (tmp_path / "my-work.zip").write_bytes(answer.content)
    work = open_my_work(tmp_path / "my-work.zip")
    assert Scene.load(work.scene).description.title == "Box chase"


def play_and_be_seen(there: ServedClass, *command: str) -> str:
    """Play until the wall shows the world; return the name of the seat."""
    with (
        played(*command, state=Path(os.environ["XDG_STATE_HOME"])) as room,
        TeacherSocket(there) as teacher,
    ):
        name = "".join(room.told).partition("Joined the class as ")[2].partition(".\n")[0]
        (number,) = (each["number"] for each in there.state()["seats"] if each["name"] == name)

        def is_shown(event: dict[str, Any]) -> bool:
            return any(
                (each["seats"], each["kind"], each["scene"]) == ([number], "remote", "Box chase")
                for each in event["rooms"]
            )

        event = teacher.next("class", is_shown)
        (mine,) = (each["id"] for each in event["rooms"] if each["seats"] == [number])
        teacher.next("drawing", lambda each: each["room"] == mine)
        there.command("attention", kind="pause", message="Look here", seconds=0)
        until(lambda: room.snapshot()["waiting"] == "teacher")
        there.command("attention", kind="", message="", seconds=0)
        until(lambda: room.snapshot()["waiting"] != "teacher")
        return name


def test_a_wrong_code_ends_play_with_a_sentence(
    there: ServedClass, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA", "HOME"):
        monkeypatch.setenv(name, str(tmp_path))

    command = [sys.executable, "-m", "ai4u_edu", "play", "--no-open", "--class", there.url]
    ended = subprocess.run(
        [*command, "--code", "WRONG"], capture_output=True, text=True, check=False
    )
    told = "error: This code is not right. Look at the board again.\n"
    assert (ended.returncode, ended.stderr) == (1, told)

    def refused(*options: str) -> str:
        answer = CliRunner().invoke(app, ["play", "--no-open", *options])
        assert answer.exit_code != 0
        return f"{answer.exception} {answer.output}"

    assert "expected the code on the board" in refused("--class", there.url)
    with reserved_port() as port:
        nowhere = f"http://127.0.0.1:{port}"
        assert "can't be reached" in refused("--class", nowhere, "--code", CODE)
    assert "expected --class" in refused("--code", CODE)
