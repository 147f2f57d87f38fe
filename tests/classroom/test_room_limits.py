"""Rooms that nobody uses, that do not answer, or that need too much memory."""

import asyncio
import os
import signal
import sys
from contextlib import closing
from pathlib import Path

import httpx
import psutil
import pytest

from ai4u_edu.classroom import LocalRooms
from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.classroom.room_watch import NICENESS, RoomLimits
from tests.waiting import until_async

pytestmark = pytest.mark.slow


async def _snapshot(address: RoomAddress, room: str) -> dict[str, object]:
    headers = {"Authorization": f"Bearer {address.token}"}
    url = f"http://{address.host}:{address.port}/r/{room}/api/snapshot"
    async with httpx.AsyncClient(trust_env=False) as client:
        found: dict[str, object] = (await client.get(url, headers=headers)).json()
        return found


def _pid_of(address: RoomAddress) -> int:
    for each in psutil.Process().children(recursive=True):
        for one in each.net_connections("tcp"):
            if one.status == psutil.CONN_LISTEN and one.laddr.port == address.port:
                return each.pid
    raise AssertionError("no process serves the room")


def test_a_room_that_nobody_uses_ends_and_wakes_with_its_start(tmp_path: Path) -> None:
    limits = RoomLimits(sleep_after_s=0.3, check_s=0.1)

    async def sleep_and_wake() -> tuple[object, object]:
        with rooms.in_use("a"):  # it may sleep at once otherwise, before its answer
            before = await _snapshot(await rooms.enter("a", "box_chase"), "a")
            await asyncio.sleep(0.8)
            assert rooms.is_running("a")
        await until_async(lambda: not rooms.is_running("a"))
        with rooms.in_use("a"):
            after = await _snapshot(await rooms.enter("a", "box_chase"), "a")
        return before["seed"], after["seed"]

    with closing(LocalRooms(tmp_path, limits=limits)) as rooms:
        before, after = asyncio.run(sleep_and_wake())
    assert before == after


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSTOP")
def test_a_room_that_does_not_answer_begins_anew(tmp_path: Path) -> None:
    limits = RoomLimits(answer_timeout_s=0.5, check_s=0.1, ask_s=0.1)

    async def stop_one() -> None:
        first, other = await asyncio.gather(*(rooms.enter(each, "box_chase") for each in "ab"))
        with rooms.in_use("a"), rooms.in_use("b"):
            os.kill(_pid_of(first), signal.SIGSTOP)
            await until_async(lambda: not rooms.is_running("a"))
            assert rooms.is_running("b")
            assert await rooms.enter("b", "box_chase") == other
            assert await rooms.enter("a", "box_chase") != first

    with closing(LocalRooms(tmp_path, limits=limits)) as rooms:
        asyncio.run(stop_one())


@pytest.mark.skipif(sys.platform != "linux", reason="priorities of threads are Linux's")
def test_all_threads_of_a_room_let_the_class_go_first(tmp_path: Path) -> None:
    async def priorities() -> set[int]:
        process = psutil.Process(_pid_of(await rooms.enter("a", "box_chase")))
        return {os.getpriority(os.PRIO_PROCESS, each.id) for each in process.threads()}

    own = os.getpriority(os.PRIO_PROCESS, 0)
    with closing(LocalRooms(tmp_path)) as rooms:
        assert asyncio.run(priorities()) == {max(own, NICENESS)}


def test_a_room_with_too_much_memory_is_ended_and_told_why(tmp_path: Path) -> None:
    limits = RoomLimits(max_memory_mb=5, check_s=0.05)

    async def twice() -> None:
        for _ in range(2):
            await rooms.enter("a", "box_chase")
            await until_async(lambda: not rooms.is_running("a"))
        with pytest.raises(RoomError, match=r"more than the 5 MB that it may"):
            await rooms.enter("a", "box_chase")

    with closing(LocalRooms(tmp_path, limits=limits)) as rooms:
        asyncio.run(twice())
