"""A class's folder: one class at a time, nobody else reads it, and its errors say their cause."""

import os
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from functools import partial
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom import ClassStore, RoomRule, Seats
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.store import FILE, teacher_token
from tests.classroom.served_class import environment, served_class
from tests.waiting import LIMIT_S

posix_only = pytest.mark.skipif(os.name != "posix", reason="permissions are POSIX's")
HOLDER = """
import sys
from pathlib import Path
from ai4u_edu.classroom import ClassStore
store = ClassStore(Path(sys.argv[1]))
print("HELD", flush=True)
sys.stdin.read()
"""


@contextmanager
def umask(mask: int) -> Iterator[None]:
    before = os.umask(mask)
    try:
        yield
    finally:
        os.umask(before)


def readable_by_others(folder: Path) -> list[str]:
    """Return files and folders that have a permission for anybody but their owner."""
    found = []
    for each in (folder, *folder.rglob("*")):
        with suppress(FileNotFoundError):  # a room's new file has its last name now
            if stat.S_IMODE(each.lstat().st_mode) & 0o077:
                found.append(str(each))
    return found


def test_a_folder_has_one_class_at_a_time(tmp_path: Path) -> None:
    with (
        ClassStore(tmp_path),
        pytest.raises(SetupError, match="another class runs in this folder"),
    ):
        ClassStore(tmp_path)
    ClassStore(tmp_path).close()


@pytest.mark.slow
def test_another_process_has_the_folder_until_it_is_killed(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment()
    ) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "HELD\n"
        with pytest.raises(SetupError, match="another class runs in this folder"):
            ClassStore(tmp_path)
        holder.send_signal(signal.SIGKILL if os.name == "posix" else signal.SIGTERM)
        holder.wait(LIMIT_S)
        ClassStore(tmp_path).close()


@pytest.mark.slow
def test_a_second_command_says_so_and_the_first_goes_on(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        command = [sys.executable, "-m", "ai4u_edu", "class", "--folder", str(tmp_path)]
        command += ["--no-open", "--host", "127.0.0.1", "--port", "0"]
        second = subprocess.run(
            command, capture_output=True, text=True, env=environment(), timeout=LIMIT_S
        )
        assert second.returncode == 1
        assert "another class runs in this folder" in second.stderr
        assert served.joined().get("healthz").status_code == 200


@posix_only
@pytest.mark.parametrize("mask", [0o000, 0o022])
def test_nobody_else_reads_a_class_whatever_the_umask(tmp_path: Path, mask: int) -> None:
    folder = tmp_path / "class"
    with umask(mask), ClassStore(folder) as store:
        seats = Seats(store, "box_chase", RoomRule())
        seats.join(seats.code, seats.offered_names()[0], "student")
        assert teacher_token(store)
        assert readable_by_others(folder) == []
        copy = tmp_path / "copy"
        shutil.copytree(folder, copy)
        assert readable_by_others(copy) == []


@posix_only
def test_a_folder_that_others_could_read_is_closed_to_them(tmp_path: Path) -> None:
    with umask(0o000):
        folder = tmp_path / "class"
        with ClassStore(folder) as store:
            assert teacher_token(store)
        folder.chmod(0o755)
        for file in folder.iterdir():
            file.chmod(0o644)
        with ClassStore(folder) as store:
            assert teacher_token(store)
            assert readable_by_others(folder) == []


@posix_only
def test_the_folder_in_which_a_program_runs_stays_open(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    tmp_path.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    with ClassStore(tmp_path):
        assert stat.S_IMODE(tmp_path.stat().st_mode) == 0o755
        assert stat.S_IMODE((tmp_path / FILE).stat().st_mode) == 0o600


@posix_only
@pytest.mark.slow
def test_what_rooms_write_is_nobody_elses_either(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with umask(0o000), served_class(folder) as served:
        ada = served.joined()
        assert ada.get("healthz").status_code == 200
        assert (folder / "rooms").is_dir()
        assert readable_by_others(folder) == []


def test_an_error_of_the_file_says_its_cause(tmp_path: Path) -> None:
    with ClassStore(tmp_path) as store:
        with pytest.raises(StoreError, match="mistake of ai4u-edu"), store.transaction() as file:
            file.execute("insert into tokens values (x'00', 99, 'r')")
        store._database.execute("pragma busy_timeout = 1")
        with closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as other:
            other.execute("begin immediate")
            with pytest.raises(StoreError, match="Another program") as raised:
                store.set_setting("a", "b")
        assert "disk" not in str(raised.value)
        store._database.execute("pragma max_page_count = 1")
        with pytest.raises(StoreError, match="The disk is full"):
            store.set_setting("a", "b" * 10**6)


def test_secrets_are_made_once_by_threads_that_ask_together(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with ClassStore(tmp_path) as store:
        # as if both had looked before one wrote
        monkeypatch.setattr(store, "setting", lambda _name, default="": default)
        made = [store.setting_or("key", partial(str, number)) for number in (1, 2)]
    assert made == ["1", "1"]
