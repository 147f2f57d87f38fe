"""Jobs on each engine: the same results, and each job that fails is reported alone."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from functools import cache
from pathlib import Path
from threading import Thread

import psutil
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.numeric_threads import ONE_THREAD
from ai4u_edu.games.jobs import (
    Engine,
    Job,
    JobOutcome,
    Journal,
    engine,
    processes,
    ray_engine,
    run_jobs,
)
from ai4u_edu.games.jobs.journal import count_done
from tests.games.jobs import functions
from tests.processes import command_line
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def engines() -> Iterator[Callable[[str], Engine]]:
    """Engines by name, each of them started once."""
    with ExitStack() as ending:

        @cache
        def started(name: str) -> Engine:
            return ending.enter_context(engine(name, width=None if name == "inline" else 2))

        yield started


ON_RAY = pytest.param("ray", marks=pytest.mark.nightly)
"""Ray takes seconds to start, and gives up where a busy machine lets it wait for half a minute."""


@pytest.fixture(params=["inline", "processes", ON_RAY])
def any_engine(request: pytest.FixtureRequest, engines: Callable[[str], Engine]) -> Engine:
    return engines(request.param)


@pytest.fixture(params=["processes", ON_RAY])
def apart(request: pytest.FixtureRequest, engines: Callable[[str], Engine]) -> Engine:
    """An engine whose jobs run in other processes."""
    return engines(request.param)


def by_job(outcomes: Iterator[JobOutcome]) -> dict[str, JobOutcome]:
    return {each.job.key: each for each in outcomes}


def test_each_job_has_its_result(any_engine: Engine) -> None:
    jobs = [Job.of(functions.square, number=number) for number in (0, 1, 2, 3.5, 1e300)]
    done = by_job(run_jobs(jobs, any_engine))
    assert [done[job.key].result for job in jobs] == [0, 1, 4, 12.25, float("inf")]
    assert all(each.is_done and each.tries == 1 and each.seconds >= 0 for each in done.values())


def test_a_result_is_as_a_journal_would_give_it(any_engine: Engine) -> None:
    (done,) = run_jobs([Job.of(functions.nested, number=3)], any_engine)
    assert done.result == {"pair": [3, 0.30000000000000004], "1": None}


def test_equal_jobs_run_once(any_engine: Engine, tmp_path: Path) -> None:
    job = Job.of(functions.note_call, folder=str(tmp_path))
    (done,) = run_jobs([job, job, Job.of(functions.note_call, folder=str(tmp_path))], any_engine)
    assert done.result == 1


def test_a_job_that_fails_is_tried_again_and_reported_alone(
    any_engine: Engine, tmp_path: Path
) -> None:
    bad, late = (
        Job.of(functions.fail, text="no"),
        Job.of(functions.fail_twice, folder=str(tmp_path)),
    )
    good = Job.of(functions.square, number=2)
    done = by_job(run_jobs([bad, late, good], any_engine))
    assert re.fullmatch(r"ValueError: no \(functions\.py:\d+\)", done[bad.key].error)
    assert (done[bad.key].tries, done[bad.key].result) == (3, None)
    assert (done[late.key].result, done[late.key].tries) == ("at last", 3)
    assert done[good.key].result == 4


def test_what_another_try_would_not_mend_is_tried_once(any_engine: Engine, tmp_path: Path) -> None:
    (done,) = run_jobs([Job.of(functions.refuse, folder=str(tmp_path))], any_engine)
    assert done.error == "expected another folder"
    assert len([*tmp_path.iterdir()]) == 1


def test_a_result_that_is_no_data_is_an_error(any_engine: Engine) -> None:
    (done,) = run_jobs([Job.of(functions.no_data)], any_engine)
    assert "not JSON serializable" in done.error


def test_a_process_that_dies_takes_no_other_job_with_it(apart: Engine, tmp_path: Path) -> None:
    deadly, once = Job.of(functions.die, number=1), Job.of(functions.die_once, folder=str(tmp_path))
    others = [Job.of(functions.square, number=number) for number in range(6)]
    done = by_job(run_jobs([*others[:3], deadly, once, *others[3:]], apart))
    assert done[deadly.key].error
    assert done[deadly.key].tries == 3
    assert done[once.key].result == "alive"
    assert [done[job.key].result for job in others] == [0, 1, 4, 9, 16, 25]


def test_jobs_run_beside_each_other(engines: Callable[[str], Engine], tmp_path: Path) -> None:
    jobs = [
        Job.of(functions.meet, folder=str(tmp_path), number=number, count=2) for number in range(2)
    ]
    found = {each.result for each in run_jobs(jobs, engines("processes"))}
    assert len(found) == 2
    assert os.getpid() not in found


def test_a_process_that_ends_tells_its_exit_code(
    engines: Callable[[str], Engine], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(processes, "END_TIMEOUT_S", LIMIT_S)
    (done,) = run_jobs([Job.of(functions.end, code=3)], engines("processes"))
    assert done.error == "its process died (exit code 3)"


def test_jobs_run_elsewhere(apart: Engine) -> None:
    (own,) = run_jobs([Job.of(functions.pid, number=0)], apart)
    assert own.result != os.getpid()


def test_numeric_libraries_have_one_thread_in_a_process_for_jobs(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ONE_THREAD:
        monkeypatch.delenv(name, raising=False)
    with engine("processes", width=1) as made:
        (done,) = run_jobs([Job.of(functions.numeric_threads)], made)
    assert done.result == 0
    assert not {*ONE_THREAD} & {*os.environ}


@pytest.mark.parametrize("name", ["processes", ON_RAY])
def test_closing_ends_what_still_runs(name: str) -> None:
    before = {each.pid for each in psutil.Process().children(recursive=True)}
    with engine(name, width=2) as made:
        made.start(Job.of(functions.rest, seconds=600))
        made.start(Job.of(functions.pid, number=1))
        made.wait()
        while_open = psutil.Process().children(recursive=True)
        started = [
            each
            for each in while_open
            if each.pid not in before and "resource_tracker" not in command_line(each)
        ]
    assert len(started) >= 2
    # the system may need a moment for those that were killed
    assert psutil.wait_procs(started, LIMIT_S)[1] == []


# -- the journal --------------------------------------------------------------------------------


def test_a_job_that_finished_is_not_run_twice(tmp_path: Path) -> None:
    calls = tmp_path / "calls"
    calls.mkdir()
    once, bad = Job.of(functions.note_call, folder=str(calls)), Job.of(functions.fail, text="no")
    for _ in range(2):
        with Journal(tmp_path / "out") as journal, engine("inline") as inline:
            done = by_job(run_jobs([once, bad], inline, journal=journal))
            assert done[once.key].result == 1
            assert done[bad.key].tries == 3, "what failed is run again"
    assert len([*calls.iterdir()]) == 1


def test_a_last_line_that_was_not_written_to_its_end_is_cut_off(tmp_path: Path) -> None:
    jobs = [Job.of(functions.square, number=number) for number in (2, 3)]
    with Journal(tmp_path) as journal, engine("inline") as inline:
        [*run_jobs(jobs, inline, journal=journal)]
    file = tmp_path / "journal.jsonl"
    whole = file.read_bytes()
    file.write_bytes(whole[:-20])
    with Journal(tmp_path) as journal, engine("inline") as inline:
        assert jobs[0] in journal
        assert jobs[1] not in journal
        assert {each.result for each in run_jobs(jobs, inline, journal=journal)} == {4, 9}
    assert [json.loads(line)["result"] for line in file.read_text().splitlines()] == [4, 9]


def test_a_damaged_line_is_told_and_nothing_is_lost(tmp_path: Path) -> None:
    with Journal(tmp_path) as journal, engine("inline") as inline:
        [*run_jobs([Job.of(functions.square, number=2)], inline, journal=journal)]
    file = tmp_path / "journal.jsonl"
    file.write_bytes(b"what?\n" + file.read_bytes())
    with pytest.raises(SetupError, match=r"line 1: expected a finished job, got b'what\?'"):
        Journal(tmp_path)
    assert len(file.read_bytes().splitlines()) == 2


def test_two_runs_of_one_folder_exclude_each_other(tmp_path: Path) -> None:
    with Journal(tmp_path), pytest.raises(SetupError, match="another process runs these jobs"):
        Journal(tmp_path)
    Journal(tmp_path).close()


PROGRAM = """
import sys
from pathlib import Path
from ai4u_edu.games.jobs import Job, Journal, engine, run_jobs
from tests.games.jobs import functions

if __name__ == "__main__":
    limit = int(sys.argv[3])  # later ones do not end
    jobs = [Job.of(functions.rest_from, number=number, limit=limit) for number in range(50)]
    with Journal(Path(sys.argv[1])) as journal, engine(sys.argv[2], width=2) as made:
        for outcome in run_jobs(jobs, made, journal=journal):
            print(outcome.job.arguments["number"], flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
@pytest.mark.parametrize("name", ["processes", ON_RAY])
def test_ctrl_c_keeps_what_is_finished_and_the_next_run_goes_on(tmp_path: Path, name: str) -> None:
    script = tmp_path / "many_jobs.py"
    script.write_text(PROGRAM)
    command = [sys.executable, str(script), str(tmp_path / "out"), name, "3"]
    options = {"env": {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, "text": True}
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        **options,  # type: ignore[call-overload]
    )
    with process:
        assert process.stdout is not None
        for _ in range(3):
            process.stdout.readline()
        family = [
            psutil.Process(process.pid),
            *psutil.Process(process.pid).children(recursive=True),
        ]
        os.killpg(process.pid, signal.SIGINT)
        process.wait(LIMIT_S)
    _, alive = psutil.wait_procs(family, timeout=LIMIT_S)
    assert not alive
    lines = (tmp_path / "out" / "journal.jsonl").read_text().splitlines()
    assert sorted(json.loads(line)["arguments"]["number"] for line in lines) == [0, 1, 2]
    with Journal(tmp_path / "out") as journal:
        assert len(journal) == 3
        jobs = [Job.of(functions.rest_from, number=number, limit=3) for number in range(4)]
        assert [job in journal for job in jobs] == [True, True, True, False]


INTERRUPTED = """
from itertools import count
from multiprocessing.connection import Connection

numbers, receive = count(1), Connection.recv

def interrupted(connection):
    answer = receive(connection)
    if next(numbers) == 4:
        raise KeyboardInterrupt
    return answer

if __name__ == "__main__":
    Connection.recv = interrupted
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no process groups")
def test_ctrl_c_just_as_an_answer_comes_ends_the_program(tmp_path: Path) -> None:
    script = tmp_path / "many_jobs.py"
    script.write_text(INTERRUPTED + PROGRAM)
    process = subprocess.Popen(
        [sys.executable, str(script), str(tmp_path / "out"), "processes", "50"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        text=True,
    )
    try:
        _, told = process.communicate(timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        raise
    assert told.rstrip().endswith("KeyboardInterrupt")


# -- what is no job ------------------------------------------------------------------------------


def test_arguments_have_to_be_plain_data() -> None:
    with pytest.raises(ValueError, match="expected arguments that JSON can hold"):
        Job.of(functions.square, number=(1, 2))
    with pytest.raises(ValueError, match="expected a function that a module defines"):
        Job.of(lambda: 1)


def test_the_key_depends_on_function_and_arguments_alone() -> None:
    keys = {
        Job.of(functions.square, number=1).key,
        Job.of(functions.square, number=2).key,
        Job.of(functions.pid, number=1).key,
    }
    assert len(keys) == 3
    assert Job("a:b", {"x": 1, "y": 2}).key == Job("a:b", {"y": 2, "x": 1}).key


def test_an_engine_that_is_not_there_is_told() -> None:
    with pytest.raises(SetupError, match="did you mean 'processes'"):
        engine("process")
    with pytest.raises(SetupError, match="--address is for --engine ray"):
        engine("inline", address="192.0.2.7:6379")


def test_a_cluster_that_is_not_there_is_told_at_once() -> None:
    with socket.socket() as silent:  # nobody else gets the port
        silent.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{silent.getsockname()[1]}"
        problem = f"expected a Ray cluster at {address}, got: .*refused"
        with pytest.raises(SetupError, match=problem):
            engine("ray", address=address)
    with pytest.raises(SetupError, match="expected one such as 192"):
        engine("ray", address="somewhere")


@pytest.mark.nightly
@pytest.mark.parametrize("answer", [b"", b"HTTP/1.1 200 OK\r\n\r\nhello"], ids=["silent", "web"])
def test_what_is_no_cluster_at_an_address_is_told_and_nothing_is_left(
    answer: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ray_engine, "START_TIMEOUT_S", 10.0)
    before = {each.pid for each in psutil.Process().children(recursive=True)}
    open_ones: list[socket.socket] = []
    with socket.create_server(("127.0.0.1", 0)) as server:

        def serve() -> None:
            with suppress(OSError):
                while True:
                    open_ones.append(server.accept()[0])
                    open_ones[-1].sendall(answer)

        Thread(target=serve, daemon=True).start()
        address = f"127.0.0.1:{server.getsockname()[1]}"
        with pytest.raises(SetupError, match=f"Ray on {address}"):
            engine("ray", address=address)
        server.shutdown(socket.SHUT_RDWR)
    for each in open_ones:
        each.close()
    started = [
        each
        for each in psutil.Process().children(recursive=True)
        if each.pid not in before and "resource_tracker" not in command_line(each)
    ]
    assert psutil.wait_procs(started, LIMIT_S)[1] == []


def test_a_journal_tells_how_many_jobs_it_has(tmp_path: Path) -> None:
    assert count_done(tmp_path) == 0
    jobs = [Job.of(functions.square, number=number) for number in (2, 3)]
    jobs.append(Job.of(functions.fail, text="no"))
    with Journal(tmp_path) as journal, engine("inline") as inline:
        [*run_jobs(jobs, inline, journal=journal)]
        assert count_done(tmp_path) == 2, "also while it is open"
    (tmp_path / "journal.jsonl").write_text("what?")
    assert count_done(tmp_path) == 0
