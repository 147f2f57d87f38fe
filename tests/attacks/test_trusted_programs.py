"""Programs under ``--trust-python``: what they start ends with them, and nothing hangs."""

import base64
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from ai4u_edu.games.jobs import Job, processes, run_jobs
from ai4u_edu.games.jobs.processes import ProcessEngine
from ai4u_edu.games.tournament import drivers
from ai4u_edu.games.tournament.contest import game_job
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.game import game
from ai4u_edu.locale import unpacked
from tests.games.jobs import functions
from tests.waiting import until

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(os.name != "posix", reason="processes are ended in another way there"),
]

SUMO = {"name": "sumo"}
DAEMON = """
import fcntl, os, signal, time
started = False

def start():
    ready, done = os.pipe()
    if os.fork():
        os.read(ready, 1)
        return
    os.setsid()
    if os.fork():
        os._exit(0)
    for number in range(1, 32):
        if number not in (signal.SIGKILL, signal.SIGSTOP):
            signal.signal(number, signal.SIG_IGN)
    held = os.open("HELD", os.O_CREAT | os.O_RDWR)
    fcntl.flock(held, fcntl.LOCK_EX)
    os.write(done, b"x")
    while True:
        time.sleep(100)

def decide(percept):
    global started
    if not started:
        started = True
        start()
    return {"move": [1, 0, 0, 0]}
"""
"""A program that starts a daemon, which holds the lock on a file for as long as it lives."""

STOPPER = """
import os, signal
stopped = False

def parent(pid):
    with open(f"/proc/{pid}/stat") as file:
        return int(file.read().rpartition(")")[2].split()[1])

def decide(percept):
    global stopped
    if not stopped:
        stopped = True
        os.kill(parent(os.getppid()), signal.SIGSTOP)
    return {"move": [1, 0, 0, 0]}
"""
"""A program that stops the process that plays."""

TRACER = STOPPER.replace(
    "os.kill(parent(os.getppid()), signal.SIGSTOP)",
    "import ctypes; ctypes.CDLL(None).ptrace(16, parent(os.getppid()), 0, 0)",
)
"""A program that stops the process that plays as a debugger does."""


def program(source: str) -> Entry:
    data = base64.b64encode(source.encode()).decode()
    driver = {"kind": "python", "file": "program.py", "name": "", "data": data}
    return Entry(name="program", drivers={"": driver})


def scripted() -> Entry:
    return Entry(name="script", drivers={"": {"kind": "scene"}})


def played(source: str) -> dict[str, Any]:
    entries = [each.model_dump(mode="json") for each in (program(source), scripted())]
    return game(SUMO, 0, entries)


@pytest.fixture(params=["alone", "with others"])
def surroundings(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Have programs see no processes but their own, or all, as where the system forbids that."""
    if request.param == "with others":
        monkeypatch.setattr(drivers, "CHILD_MODULE", "tests.attacks.child_among_others")
    return str(request.param)


def is_free(path: Path) -> bool:
    """Return True if no process holds the lock on a file."""
    import fcntl

    with path.open("rb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
    return True


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lets a process adopt orphans")
@pytest.mark.usefixtures("surroundings")
def test_a_daemon_of_a_program_ends_with_the_game(tmp_path: Path) -> None:
    held = tmp_path / "held"
    told = played(DAEMON.replace("HELD", str(held)))
    assert (told["forfeit"], told["reason"]) == (-1, "")
    assert held.exists(), "the daemon was there"
    until(lambda: is_free(held))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lets a process adopt orphans")
@pytest.mark.usefixtures("surroundings")
def test_a_daemon_of_a_program_ends_with_the_process_that_plays(tmp_path: Path) -> None:
    held = tmp_path / "held"
    source = DAEMON.replace("HELD", str(held)).replace(
        '    return {"move"', "    time.sleep(3600)\n    return {'other'"
    )
    code = (
        "import json, sys\n"
        "from ai4u_edu.games.tournament import drivers\n"
        "drivers.CHILD_MODULE, entries = json.load(sys.stdin)\n"
        "from ai4u_edu.games.tournament.game import game\n"
        "game({'name': 'sumo'}, 0, entries)\n"
    )
    entries = [each.model_dump_json() for each in (program(source), scripted())]
    text = f'["{drivers.CHILD_MODULE}", [{", ".join(entries)}]]'
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    pipe = subprocess.PIPE
    with subprocess.Popen([sys.executable, "-c", code], stdin=pipe, env=env, text=True) as player:
        assert player.stdin is not None
        player.stdin.write(text)
        player.stdin.close()
        until(lambda: held.exists() and not is_free(held))
        player.kill()
    until(lambda: is_free(held))


@pytest.mark.skipif(sys.platform != "linux", reason="the program looks into /proc")
def test_a_program_that_stops_the_process_that_plays_hangs_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(processes, "STOP_POLL_S", 0.02)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
    job = Job.of(functions.play_among_others, **game_job(SUMO, 0, duel(STOPPER)).arguments)
    with ProcessEngine(1) as engine:
        (done,) = run_jobs([job], engine, tries=1)
    assert (done.error, done.result["forfeit"]) == ("", -1)


@pytest.mark.skipif(sys.platform != "linux", reason="ptrace is called as Linux has it")
def test_a_process_that_a_program_traces_is_ended_and_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if not may_trace_parents():
        pytest.skip("this system lets nobody trace other processes")
    monkeypatch.setattr(processes, "STOP_POLL_S", 0.02)
    monkeypatch.setattr(processes, "STOP_TIMEOUT_S", 0.2)
    job = Job.of(functions.play_among_others, **game_job(SUMO, 0, duel(TRACER)).arguments)
    others = [Job.of(functions.square, number=number) for number in range(3)]
    with ProcessEngine(1) as engine:
        done = {each.job.key: each for each in run_jobs([job, *others], engine, tries=1)}
    assert done[job.key].error == "its process was stopped by another one for 0.2 s"
    assert [done[each.key].result for each in others] == [0, 1, 4]


def duel(source: str) -> tuple[Entry, Entry]:
    return program(source), scripted()


def may_trace_parents() -> bool:
    """Return True if a process may trace the one that started it."""
    code = (
        "import ctypes, os; libc = ctypes.CDLL(None); found = libc.ptrace(16, os.getppid(), 0, 0)\n"
        "found or (os.waitpid(os.getppid(), 0x40000000), libc.ptrace(17, os.getppid(), 0, 0))\n"
        "raise SystemExit(found != 0)"
    )
    middle = f"import subprocess, sys; sys.exit(subprocess.call([sys.executable, '-c', {code!r}]))"
    return subprocess.run([sys.executable, "-c", middle], check=False).returncode == 0


@pytest.mark.skipif(sys.platform != "linux", reason="the program looks into /proc")
def test_a_program_sees_no_processes_but_its_own() -> None:
    if not may_unshare():
        pytest.skip("this system lets no process leave the others' namespaces")
    told = played(LOOKER)
    assert unpacked(told["reason"]).endswith("RuntimeError: [1] 1 0.")


LOOKER = """
import os

def decide(percept):
    seen = sorted(int(name) for name in os.listdir("/proc") if name.isdigit())
    raise RuntimeError(f"{seen} {os.getpid()} {os.getppid()}")
"""


def may_unshare() -> bool:
    """Return True if a process may have processes and a /proc of its own."""
    words = ["unshare", "--user", "--map-root-user", "--pid", "--net", "--fork", "--mount-proc"]
    try:
        return subprocess.run([*words, "true"], check=False, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


def test_nothing_of_these_tests_is_left() -> None:
    until(lambda: not children_of_programs())


def children_of_programs() -> list[psutil.Process]:
    return [
        each
        for each in psutil.Process().children(recursive=True)
        if any("python_child" in word or "child_among_others" in word for word in _words(each))
    ]


def _words(process: psutil.Process) -> list[str]:
    try:
        return process.cmdline()
    except psutil.Error:
        return []
