"""Files that are there whole or not at all; what killed writers leave is cleaned up."""

import errno
import multiprocessing
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu.base import atomic_write
from ai4u_edu.base.atomic_write import partial_file, remove_leftovers, write_atomically
from ai4u_edu.base.file_lock import FileLock, LockedError, is_locked
from tests.waiting import LIMIT_S

KILLED = """
import os, signal, sys
from pathlib import Path
from ai4u_edu.base.atomic_write import partial_file
with partial_file(Path(sys.argv[1])) as beside:
    beside.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def left_by_a_killed_writer(file: Path) -> Path:
    before = set(file.parent.iterdir())
    done = subprocess.run([sys.executable, "-c", KILLED, str(file)], check=False)
    assert done.returncode == -signal.SIGKILL
    (left,) = set(file.parent.iterdir()) - before
    return left


def test_a_file_is_replaced_whole_and_keeps_its_permissions(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    write_atomically(file, "one")
    file.chmod(0o640)
    write_atomically(file, b"two")
    assert file.read_bytes() == b"two"
    assert file.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [file]


def test_a_new_file_may_be_read_by_whom_the_umask_lets(tmp_path: Path) -> None:
    before = os.umask(0o022)
    try:
        write_atomically(tmp_path / "open", "x")
        write_atomically(tmp_path / "private", "x", mode=0o600)
    finally:
        os.umask(before)
    assert (tmp_path / "open").stat().st_mode & 0o777 == 0o644
    assert (tmp_path / "private").stat().st_mode & 0o777 == 0o600


def test_what_was_there_stays_if_writing_fails(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    write_atomically(file, "one")

    def fail() -> None:
        with partial_file(file) as beside:
            beside.write_text("tw")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert file.read_text() == "one"
    assert list(tmp_path.iterdir()) == [file]


def test_a_full_disk_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_path: Path) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    file = tmp_path / "a.yaml"
    write_atomically(file, "one")
    monkeypatch.setattr(atomic_write, "_flush_file", full)
    with pytest.raises(OSError, match="No space"):
        write_atomically(file, "two")
    assert file.read_text() == "one"
    assert list(tmp_path.iterdir()) == [file]


def test_a_new_file_replaces_none(tmp_path: Path) -> None:
    file = tmp_path / "a.episode"
    write_atomically(file, "one", over=False)
    with pytest.raises(FileExistsError):
        write_atomically(file, "two", over=False)
    assert file.read_text() == "one"
    assert list(tmp_path.iterdir()) == [file]


def test_a_file_system_without_hard_links_will_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_link(_one: Path, _other: Path) -> None:
        raise PermissionError(errno.EPERM, "no links here")

    monkeypatch.setattr(os, "link", no_link)
    test_a_new_file_replaces_none(tmp_path)


def test_a_long_name_is_not_too_long(tmp_path: Path) -> None:
    file = tmp_path / ("x" * 250 + ".yaml")
    write_atomically(file, "one")
    assert file.read_text() == "one"


def test_a_link_is_followed_and_a_device_is_written_to(tmp_path: Path) -> None:
    file, link = tmp_path / "file", tmp_path / "link"
    link.symlink_to(file)
    write_atomically(link, "one")
    assert link.is_symlink()
    assert file.read_text() == "one"
    write_atomically(Path(os.devnull), "one")


def test_a_killed_writer_s_file_goes_at_the_next_start(tmp_path: Path) -> None:
    file = tmp_path / "scene.yaml"
    left = left_by_a_killed_writer(file)
    (tmp_path / "notes.tmp").touch()
    (tmp_path / ".ai4u-partial-notes").touch()
    target = tmp_path / "target"
    target.touch()
    (tmp_path / f"{atomic_write.PREFIX}0123456789abcdef").symlink_to(target)
    os.mkfifo(tmp_path / f"{atomic_write.PREFIX}0123456789abcdee")
    assert left.suffix == ".yaml"
    assert remove_leftovers(tmp_path) == 1
    assert not left.exists()
    with partial_file(tmp_path / "other") as beside:
        assert remove_leftovers(tmp_path) == 0
        assert beside.exists()
    assert len(list(tmp_path.iterdir())) == 6
    assert remove_leftovers(tmp_path / "nowhere") == 0


def test_a_process_cleans_a_folder_before_it_first_writes_there(tmp_path: Path) -> None:
    file = tmp_path / "scene.yaml"
    left_by_a_killed_writer(file)
    left_by_a_killed_writer(file)  # which has removed the first one
    write_atomically(file, "one")
    assert list(tmp_path.iterdir()) == [file]


def test_a_file_that_is_taken_for_a_leftover_is_begun_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[Path] = []

    class Raced(FileLock):
        def __init__(self, path: Path) -> None:
            if not made:
                path.unlink()  # by another process, after it was made and before it was locked
            made.append(path)
            super().__init__(path)

    monkeypatch.setattr(atomic_write, "FileLock", Raced)
    write_atomically(tmp_path / "a", "one")
    assert (tmp_path / "a").read_text() == "one"
    assert [file.name for file in tmp_path.iterdir()] == ["a"]


def hold(path: str, ready: "multiprocessing.synchronize.Event") -> None:
    lock = FileLock(Path(path))
    ready.set()
    signal.pause()
    lock.release()


def test_a_lock_ends_with_its_process(tmp_path: Path) -> None:
    spawn = multiprocessing.get_context("spawn")
    ready, path = spawn.Event(), tmp_path / "x.lock"
    holder = spawn.Process(target=hold, args=(str(path), ready), daemon=True)
    holder.start()
    assert ready.wait(LIMIT_S)
    assert is_locked(path)
    with pytest.raises(LockedError, match="in use by another process"):
        FileLock(path)
    holder.kill()
    holder.join()
    assert not is_locked(path)
    lock = FileLock(path)
    with pytest.raises(LockedError):
        FileLock(path)
    lock.release(remove=True)
    lock.release()
    assert not path.exists()
    assert not is_locked(path)


@pytest.mark.skipif(sys.platform == "win32", reason="locks as POSIX has them")
@pytest.mark.parametrize("number", [errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP])
def test_a_file_system_without_locks_excludes_nobody_and_keeps_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    import fcntl

    def refuse(_fd: int, _operation: int) -> None:
        raise OSError(number, "no locks here")

    monkeypatch.setattr(fcntl, "flock", refuse)
    lock = FileLock(tmp_path / "a.lock")
    assert not lock.is_held
    assert not is_locked(tmp_path / "a.lock")
    lock.release()
    write_atomically(tmp_path / "a", "one")
    write_atomically(tmp_path / "a", "two")
    assert (tmp_path / "a").read_text() == "two"
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a", "a.lock"]
