"""Bad days of a class: what a person is told, and that nothing and nobody gets lost."""

import asyncio
import contextlib
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import httpx
import psutil
import pytest

from ai4u_edu.page.server.limits.attempts import MAX_WRONG
from tests.classroom.served_class import CODE, ServedClass, Student, served_class
from tests.page.server import http_client
from tests.page.server.rooms import Page, connected
from tests.waiting import until, until_async

pytestmark = pytest.mark.slow
MARKUP = "<img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


@pytest.fixture(scope="module")
def pair(served: ServedClass) -> tuple[Student, Student]:
    return served.joined(), served.joined()


def test_a_new_code_keeps_who_is_there_and_the_old_one_is_refused(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = served.joined()
        assert served.command("new code").status_code == 200
        code = served.state()["code"]
        assert ada.get("healthz").status_code == 200
        late = served.student()
        refused = late.join(CODE)
        assert (refused.status_code, refused.json()["problem"]) == (
            403,
            "This code is not right. Look at the board again.",
        )
        assert late.join(code).status_code == 200


def test_banned_student_cannot_rejoin_with_the_cookie(served: ServedClass) -> None:
    ada = served.joined()
    number = max(each["number"] for each in served.state()["seats"])
    assert served.command("ban", seat=number).status_code == 200
    assert ada.get("api/snapshot").status_code == 403
    answer = ada.join()
    assert answer.status_code == 403
    assert answer.json()["problem"] == "You may not join this class. Ask your teacher."


def test_two_tabs_of_one_seat_share_the_world_and_one_drives(served: ServedClass) -> None:
    ada = served.joined()
    with (
        Page(ada.address + "ws/input", additional_headers=ada.cookies) as first,
        Page(ada.address + "ws/input", additional_headers=ada.cookies) as second,
    ):
        number = first.receive("hello")["you"]
        second.receive("hello")
        with first.holding("KeyW"):
            until(lambda: second.receive("seat")["driver"] == number)


def test_a_pair_shares_a_world_and_sees_each_other(tmp_path: Path) -> None:
    with served_class(tmp_path, "--rooms", "pairs") as served:
        ada, ben, eve = served.joined(), served.joined(), served.joined()
        assert ada.room == ben.room != eve.room
        names = {each["name"] for each in served.state()["seats"][:2]}
        with (
            Page(ada.address + "ws/input", additional_headers=ada.cookies) as first,
            Page(ben.address + "ws/input", additional_headers=ben.cookies) as second,
        ):
            for page in (first, second):
                page.receive("hello")
            until(lambda: {each["name"] for each in people(first) if each["is_here"]} == names)
            number = first.last["hello"]["you"]
            with first.holding("KeyW"):
                until(lambda: second.receive("seat")["driver"] == number)


def people(page: Page) -> list[dict[str, object]]:
    event = page.receive("class")
    found: list[dict[str, object]] = event["people"]
    return found


def test_lost_cookie_gives_another_seat_and_keeps_the_work(served: ServedClass) -> None:
    ada = served.joined()
    before = ada.room
    ada.client.cookies.clear()
    assert ada.get("api/snapshot").status_code == 403
    assert ada.join().status_code == 200
    assert ada.room != before
    assert before.split("/")[2] in {each["room"] for each in served.state()["seats"]}


@pytest.mark.parametrize(
    "path",
    [
        "r/../class.sqlite3",
        "r/{room}/../../class.sqlite3",
        "r/{room}/%2e%2e/{other}/api/scene",
        "r/{room}/..%2f{other}/api/scene",
        "r/{room}//../{other}/api/scene",
        "r/%2e%2e/%2e%2e/etc/passwd",
        "web/..%2f..%2fclass.sqlite3",
        "web/%2e%2e/pyproject.toml",
    ],
)
def test_no_path_leads_out_of_ones_own_room(
    served: ServedClass, pair: tuple[Student, Student], path: str
) -> None:
    ada, ben = pair
    target = "/" + path.format(room=ada.room.split("/")[2], other=ben.room.split("/")[2])
    request = f"GET {target} HTTP/1.1\r\nHost: {httpx.URL(served.url).netloc.decode()}\r\n"
    request += f"Cookie: {ada.cookies['Cookie']}\r\nConnection: close\r\n\r\n"
    with connected(served.url) as raw:
        raw.sendall(request.encode())
        answer = b"".join(iter(lambda: raw.recv(65536), b""))
    status = int(answer.split()[1])
    assert status in (303, 307, 400, 403, 404), answer[:200]
    assert b"SQLite" not in answer


def test_a_name_with_markup_is_refused_as_text(served: ServedClass) -> None:
    answer = served.student().join(name=MARKUP)
    assert answer.status_code == 403
    assert answer.headers["content-type"] == "application/json"
    assert served.command("rename", seat=1, name=MARKUP).status_code == 400


@pytest.mark.nightly
def test_a_flood_of_wrong_codes_lets_the_class_join_meanwhile(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        guessed = 0
        has_joined = False

        async def guess(client: httpx.AsyncClient) -> None:
            nonlocal guessed
            while not has_joined:
                body = {"code": "XXXXX", "name": "no", "request": "guess" * 4}
                answer = await client.post("api/join", json=body)
                assert answer.status_code == 403
                guessed += 1

        async def flood() -> None:
            nonlocal has_joined
            limits = httpx.Limits(max_connections=60)
            async with http_client.AsyncClient(base_url=served.url, limits=limits) as client:
                guesses = [asyncio.create_task(guess(client)) for _ in range(40)]
                await until_async(lambda: guessed > MAX_WRONG)
                answer = await asyncio.to_thread(lambda: served.student().join())
                assert answer.status_code == 200
                has_joined = True
                await asyncio.gather(*guesses)

        asyncio.run(flood())


def test_thirty_join_at_once_and_everybody_gets_one_seat(served: ServedClass) -> None:
    before = len(served.state()["seats"])

    async def join(client: httpx.AsyncClient, number: int) -> str:
        body = {"code": CODE, "name": "", "request": f"at-once-{number:012}"}
        while True:
            for name in (await client.get("api/names")).json()["names"]:
                answer = await client.post("api/join", json=body | {"name": name})
                if answer.status_code == 200:
                    room: str = answer.json()["room"]
                    return room

    async def all_join() -> list[str]:
        async with contextlib.AsyncExitStack() as stack:
            clients = [
                await stack.enter_async_context(http_client.AsyncClient(base_url=served.url))
                for _ in range(30)
            ]
            return await asyncio.gather(*(join(*each[::-1]) for each in enumerate(clients)))

    rooms = asyncio.run(all_join())
    assert len(set(rooms)) == 30
    assert len(served.state()["seats"]) == before + 30


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGSTOP")
def test_a_class_that_slept_with_the_laptop_goes_on(served: ServedClass) -> None:
    ada = served.joined()
    ada.get("healthz")
    root = psutil.Process(served.process.pid)
    everything = [root, *root.children(recursive=True)]
    with Page(ada.address + "ws/input", additional_headers=ada.cookies) as page:
        page.receive("hello")
        for each in everything:
            with contextlib.suppress(psutil.NoSuchProcess):  # the room of another test sleeps now
                each.suspend()
        time.sleep(3)  # real time: the lid is closed; it may also be closed for longer
        for each in everything:
            with contextlib.suppress(psutil.NoSuchProcess):
                each.resume()
        with page.holding("KeyW"):
            until(lambda: ada.get("api/snapshot").json()["tick"] > 10)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits another process")
def test_full_disk_gives_a_sentence_and_keeps_acknowledged_data(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada = served.joined()
        ada.get("healthz")
        process = psutil.Process(served.process.pid)
        _, hard = process.rlimit(psutil.RLIMIT_FSIZE)
        largest = max(each.stat().st_size for each in tmp_path.iterdir() if each.is_file())
        process.rlimit(psutil.RLIMIT_FSIZE, (largest, hard))
        late = served.student()
        answer = late.join()
        assert answer.status_code == 503, answer.text
        assert "disk" in answer.json()["problem"]
        assert ada.get("healthz").status_code == 200  # whoever is there goes on
        assert served.command("new code").status_code == 400
        assert served.state()["code"] == CODE
        process.rlimit(psutil.RLIMIT_FSIZE, (hard, hard))
        assert late.join().status_code == 200
        os.kill(served.process.pid, signal.SIGKILL)
    with served_class(tmp_path) as served:
        assert len(served.state()["seats"]) == 2
