"""Rooms that nobody uses, that do not answer, or that need too much memory."""

import asyncio
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import httpx
import psutil
import pytest

from ai4u_edu.classroom import LocalRooms
from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.classroom.room_watch import NICENESS, RoomLimits, RoomWatch, time_in_queue
from tests.page.server import http_client
from tests.page.server.rooms import Clock
from tests.processes import ports_of
from tests.waiting import LIMIT_S, until, until_async

pytestmark = pytest.mark.slow


async def _snapshot(address: RoomAddress, room: str) -> dict[str, object]:
    headers = {"Authorization": f"Bearer {address.token}"}
    url = f"http://{address.host}:{address.port}/r/{room}/api/snapshot"
    async with http_client.AsyncClient(trust_env=False) as client:
        found: dict[str, object] = (await client.get(url, headers=headers)).json()
        return found


def _pid_of(address: RoomAddress) -> int:
    children = psutil.Process().children(recursive=True)
    return next(each.pid for each in children if address.port in ports_of(each))


@contextmanager
def local_rooms(folder: Path, clock: Clock, **limits: float) -> Iterator[LocalRooms]:
    """Runs rooms that are checked all the time."""
    patient = {"check_s": 0.02, "start_timeout_s": LIMIT_S, "end_timeout_s": LIMIT_S}
    with closing(LocalRooms(folder, limits=RoomLimits(**(patient | limits)), clock=clock)) as rooms:
        yield rooms


def test_a_room_that_nobody_uses_ends_and_wakes_with_its_start(tmp_path: Path) -> None:
    clock = Clock(1000.0)

    async def sleep_and_wake() -> tuple[object, object]:
        with rooms.in_use("a"):  # it may sleep at once otherwise, before its answer
            before = await _snapshot(await rooms.enter("a", "box_chase"), "a")
            await rooms.enter("b", "box_chase")
            clock.now += 301
            await until_async(lambda: not rooms.is_running("b"))
            assert rooms.is_running("a")  # which was checked with the other one
        clock.now += 299
        await rooms.enter("b", "box_chase")
        assert rooms.is_running("a")
        clock.now += 2
        await until_async(lambda: not rooms.is_running("a"))
        assert rooms.is_running("b")
        with rooms.in_use("a"):
            after = await _snapshot(await rooms.enter("a", "box_chase"), "a")
        return before["seed"], after["seed"]

    # no answer is late by this clock, which jumps
    with local_rooms(tmp_path, clock, sleep_after_s=300.0, answer_timeout_s=1e9) as rooms:
        before, after = asyncio.run(sleep_and_wake())
    assert before == after


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSTOP")
def test_a_room_that_does_not_answer_begins_anew(tmp_path: Path) -> None:
    clock = Clock(1000.0)

    async def stop_one() -> None:
        first, other = await asyncio.gather(*(rooms.enter(each, "box_chase") for each in "ab"))
        with rooms.in_use("a"):
            os.kill(_pid_of(first), signal.SIGSTOP)

            def has_ended() -> bool:
                clock.now += 1
                return not rooms.is_running("a")

            await until_async(has_ended)
            assert rooms.is_running("b")
            assert await rooms.enter("b", "box_chase") == other
            assert await rooms.enter("a", "box_chase") != first

    with local_rooms(tmp_path, clock, answer_timeout_s=60.0, sleep_after_s=0.0) as rooms:
        asyncio.run(stop_one())


@pytest.fixture
def idle_pid() -> Iterator[int]:
    """Id of a process that waits until the end of the test."""
    wait = [sys.executable, "-c", "input()"]
    with subprocess.Popen(wait, stdin=subprocess.PIPE) as process:
        yield process.pid
        process.kill()


@pytest.mark.parametrize("status", [200, 503])
def test_an_answer_of_any_status_is_a_sign_of_life(idle_pid: int, status: int) -> None:
    asked: list[str] = []

    def answer(request: httpx.Request) -> httpx.Response:
        asked.append(request.headers["Authorization"])
        if len(asked) in (2, 3):
            raise httpx.ReadTimeout("it is busy")
        return httpx.Response(status)

    clock = Clock(1000.0)
    limits = RoomLimits(answer_timeout_s=60.0, ask_s=24.0, max_memory_mb=1e9)
    watch = RoomWatch(idle_pid, limits, clock)

    async def ask() -> str:
        async with httpx.AsyncClient(transport=httpx.MockTransport(answer)) as client:
            await watch.ask(client, "http://room/healthz", RoomAddress("room", 1, "secret"))
            return watch.broken_limit()

    told = []
    for _ in range(5):
        told.append(asyncio.run(ask()))
        clock.now += 24
    assert told == [""] * 5
    assert asked == ["Bearer secret"] * 5
    asyncio.run(ask())
    assert len(asked) == 6
    clock.now += 23.9
    asyncio.run(ask())
    assert len(asked) == 6, "it is not asked more often"


def test_a_late_answer_is_a_sign_of_life(idle_pid: int) -> None:
    clock = Clock(1000.0)
    queued = {1: 0.0}
    limits = RoomLimits(max_memory_mb=1e9)
    watch = RoomWatch(idle_pid, limits, clock, queue_clock=lambda _pid: dict(queued))
    timeouts: list[float | None] = []

    async def ask_twice() -> list[str]:
        answers = asyncio.Event()

        async def answer(request: httpx.Request) -> httpx.Response:
            timeouts.append(request.extensions["timeout"]["read"])
            await answers.wait()
            return httpx.Response(200)

        async with httpx.AsyncClient(transport=httpx.MockTransport(answer)) as client:
            request = client, "http://room/healthz", RoomAddress("room", 1, "secret")
            asked = asyncio.create_task(watch.ask(*request))
            await until_async(lambda: len(timeouts) == 1)
            clock.now += 19
            await watch.ask(*request)
            told = [watch.broken_limit()]
            clock.now += 80
            queued[1] += 80.0  # it gets no processor
            await watch.ask(*request)
            told.append(watch.broken_limit())
            answers.set()
            await asked
            clock.now += 19
            return [*told, watch.broken_limit()]

    assert asyncio.run(ask_twice()) == ["", "", ""]
    assert timeouts == [None]


def _ask_in_vain(watch: RoomWatch) -> str:
    """Ask a process that does not answer; return the sentence about the limit that it breaks."""

    def nothing(_: httpx.Request) -> httpx.Response:
        raise httpx.ReadTimeout("it is stopped")

    async def ask() -> str:
        async with httpx.AsyncClient(transport=httpx.MockTransport(nothing)) as client:
            await watch.ask(client, "http://room/healthz", RoomAddress("room", 1, "secret"))
            return watch.broken_limit()

    return asyncio.run(ask())


def test_a_room_without_an_answer_breaks_its_limit(idle_pid: int) -> None:
    clock = Clock(1000.0)
    limits = RoomLimits(max_memory_mb=1e9)
    watch = RoomWatch(idle_pid, limits, clock, queue_clock=lambda _pid: {1: 7.0})

    assert _ask_in_vain(watch) == ""
    clock.now += 20
    assert _ask_in_vain(watch) == ""
    clock.now += 0.1
    assert "did not answer any more" in _ask_in_vain(watch)


def test_time_in_which_a_room_had_no_processor_does_not_count(idle_pid: int) -> None:
    clock = Clock(1000.0)
    queued = {1: 7.0, 2: 0.0}
    limits = RoomLimits(max_memory_mb=1e9)
    watch = RoomWatch(idle_pid, limits, clock, queue_clock=lambda _pid: dict(queued))

    assert _ask_in_vain(watch) == ""
    clock.now += 25
    queued |= {1: 12.5, 3: 4.0}  # they take turns at Python's lock
    assert _ask_in_vain(watch) == ""
    clock.now += 4.4
    assert _ask_in_vain(watch) == ""
    clock.now += 0.2
    assert "did not answer any more" in _ask_in_vain(watch)


def test_what_a_room_computes_counts_though_its_threads_wait_for_each_other() -> None:
    queued = {1: 0.0}
    # real time: the process computes for that long
    limits = RoomLimits(max_memory_mb=1e9, answer_timeout_s=1.0)
    clock = Clock(1000.0)
    with subprocess.Popen([sys.executable, "-c", "while True: pass"]) as process:
        watch = RoomWatch(process.pid, limits, clock, queue_clock=lambda _pid: dict(queued))
        assert _ask_in_vain(watch) == ""
        clock.now += 1000
        queued[1] += 3000
        until(lambda: "did not answer any more" in watch.broken_limit())
        process.kill()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells it")
def test_a_process_beside_another_one_on_its_core_waits_for_it() -> None:
    core = min(os.sched_getaffinity(0))
    pin = f"import os; os.sched_setaffinity(0, [{core}])\nwhile True: pass"
    with (
        subprocess.Popen([sys.executable, "-c", pin]) as one,
        subprocess.Popen([sys.executable, "-c", pin]) as other,
    ):
        until(lambda: max(time_in_queue(one.pid).values()) > 0.05)
        one.kill()
        other.kill()
    assert time_in_queue(one.pid) == {}


@pytest.mark.skipif(sys.platform != "linux", reason="priorities of threads are Linux's")
def test_all_threads_of_a_room_let_the_class_go_first(tmp_path: Path) -> None:
    async def priorities() -> set[int]:
        process = psutil.Process(_pid_of(await rooms.enter("a", "box_chase")))
        found = set()
        for each in process.threads():
            with suppress(ProcessLookupError):  # one that was there for the start
                found.add(os.getpriority(os.PRIO_PROCESS, each.id))
        return found

    own = os.getpriority(os.PRIO_PROCESS, 0)
    with local_rooms(tmp_path, Clock(1000.0), check_s=LIMIT_S) as rooms:
        assert asyncio.run(priorities()) == {max(own, NICENESS)}


def test_a_room_with_too_much_memory_is_ended_and_told_why(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    async def twice() -> None:
        for _ in range(2):
            await rooms.enter("a", "box_chase")
            await until_async(lambda: not rooms.is_running("a"))
        with pytest.raises(RoomError, match=r"more than the 5 MB that it may"):
            await rooms.enter("a", "box_chase")
        clock.now += 2
        await rooms.enter("a", "box_chase")

    clock = Clock(1000.0)
    with local_rooms(tmp_path, clock, max_memory_mb=5.0) as rooms:
        asyncio.run(twice())
    assert "room a is ended: Your world used" in caplog.text


def test_the_class_logs_how_a_room_ended_by_itself(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    async def kill_one() -> None:
        process = psutil.Process(_pid_of(await rooms.enter("a", "box_chase")))
        clock.now += 90
        process.kill()
        await until_async(lambda: not rooms.is_running("a"))
        await rooms.enter("a", "box_chase")

    clock = Clock(1000.0)
    with local_rooms(tmp_path, clock, sleep_after_s=0.0) as rooms:
        asyncio.run(kill_one())
    code = "-9" if sys.platform != "win32" else "15"
    assert f"room a ended after 90 s with exit code {code}" in caplog.text
