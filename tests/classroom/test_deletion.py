"""A seat that is deleted: nothing of it is left, and everything of the others is."""

import asyncio
import json
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.errors import CommandError
from ai4u_edu.classroom.tournament.runner import TournamentRunner
from ai4u_edu.classroom.tournament.tournaments import TournamentRow
from ai4u_edu.wire.class_link import LinkProblem
from tests.classroom import test_missions as missions
from tests.classroom import test_programs as programs
from tests.classroom import test_stars as stars
from tests.classroom.link_client import RawLink
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.test_export import found_in, work, zip_of
from tests.classroom.test_practice_queue import AWAY, LATE
from tests.classroom.test_trainings import driver, folder_of, learn, learner, page_of, process_of
from tests.waiting import LIMIT_S, until

HER_PROGRAM, HIS_PROGRAM = "speed = 0.123  # hers", "speed = 0.456  # his"


def work_in_the_page(student: Student, program: str) -> None:
    assert programs.put(student, source=program).status_code == 200
    assert stars.put(student).status_code == 200
    place = {"mission": "drive-1", "step": 1, "is_done": False, "hint": "", "hints": 0}
    reached = {"drive-1": {"steps": 1, "stars": 0}}
    answer = missions.put(student, missions=reached, place=place)
    assert answer.status_code == 200, answer.text


def forget(served: ServedClass, seat: int) -> None:
    answer = served.command("forget seat", seat=seat)
    assert answer.status_code == 200, answer.text


@pytest.mark.slow
def test_nothing_of_a_seat_is_left_and_everything_of_the_others(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        work(served, ada)
        work_in_the_page(ada, HER_PROGRAM)
        work_in_the_page(ben, HIS_PROGRAM)
        assert ben.get("healthz").status_code == 200
        before, room = served.state(), folder_of(served, ada)
        assert served.command("show", kind="room", room=room.name).status_code == 200
        assert served.command("move code", seat=1).status_code == 200

        with RawLink(served, ada) as link:
            forget(served, 1)
            problem = link.next(LinkProblem)
            assert problem.text == "Your teacher has deleted this seat, with everything of it."
        after = served.state()
        assert [seat["name"] for seat in after["seats"]] == ["Blue Otter"]
        assert [each["id"] for each in after["rooms"]] == [folder_of(served, ben).name]
        assert after["race"]["board"] == []
        for kind in ("progress", "stars", "mission_progress", "mission_places", "runs"):
            assert set(after[kind]) <= {"2"}, kind
        assert (set(before["mission_progress"]), set(before["progress"])) == ({"1", "2"}, {"1"})
        assert after["handed_in"]["networks"] == []
        assert after["shown"]["kind"] == "join"

        secrets = [*ada.client.cookies.values()]
        words = [*secrets, "Red Fox", room.name, "seat-1", "narrow", "secret name", "# hers"]
        assert found_in(folder, words) == []
        assert not any("Red Fox" in name for name in zip_of(served.export()))
        assert ada.get("api/snapshot").status_code == 403
        assert ada.client.get("api/my-work").status_code == 403

        assert programs.found(ben)["source"] == HIS_PROGRAM
        assert ben.get("healthz").status_code == 200
        answer = served.command("forget seat", seat=1)
        assert (answer.status_code, answer.json()["problem"]) == (400, "there is no seat 1")
        assert served.joined(name="Red Fox").get("healthz").status_code == 200
    with served_class(folder) as served:
        assert [seat["name"] for seat in served.state()["seats"]] == ["Blue Otter", "Red Fox"]
        assert set(served.state()["mission_progress"]) == {"2"}


@pytest.mark.slow
def test_what_learns_in_its_room_ends_and_that_of_others_goes_on(tmp_path: Path) -> None:
    with served_class(tmp_path) as served:
        ada, eve, ben = driver(served), driver(served), driver(served)
        with page_of(ada) as hers, page_of(eve) as eves, page_of(ben) as his:
            eves.done("teach_practise", steps=LATE, weights=AWAY)
            eves.part("teach", lambda p: p["practice"] and p["practice"]["decisions"] > 0)
            practising = process_of(served, "practice_process")
            learn(hers)
            learning = learner(served)
            learn(his)
            his.part("teach", lambda p: p["learning"] and p["learning"]["waiting"])
            for seat, student in ((1, ada), (2, eve)):
                forget(served, seat)
                assert not folder_of(served, student).exists()
            assert psutil.wait_procs([practising, learning], LIMIT_S)[1] == []
            his.part("teach", lambda p: len(p["networks"]) == 1)
    with ClassStore(tmp_path) as store:
        (room,) = [each.id for each in store.rooms()]
        assert store.query("select room from trainings") == [(room,)]
        assert store.query("select room from practices") == []


@pytest.mark.slow
def test_a_room_that_somebody_else_has_stays(tmp_path: Path) -> None:
    with served_class(tmp_path, "--rooms", "one") as served:
        ada, ben = served.joined(), served.joined()
        assert ada.room == ben.room
        assert ada.get("healthz").status_code == 200
        assert ada.client.post(ada.room + "api/scene", json={"name": "maze"}).status_code == 200
        until(lambda: (folder_of(served, ben) / "scene.yaml").is_file())
        forget(served, 1)
        assert ada.get("api/snapshot").status_code == 403
        assert ben.get("api/snapshot").status_code == 200
        assert (folder_of(served, ben) / "scene.yaml").is_file()


# -- tournaments -----------------------------------------------------------------------------------


@pytest.fixture
def runner(tmp_path: Path) -> Iterator[TournamentRunner]:
    with ClassStore(tmp_path) as store:
        yield TournamentRunner(store, lambda _: None, lambda: None)


def played(runner: TournamentRunner, *seats: int) -> TournamentRow:
    """A tournament that the networks of some seats have played."""
    asyncio.run(runner.begin("sumo"))
    row = runner.tournaments.now
    assert row is not None
    runner.tournaments.folder_of(row).mkdir(parents=True)
    work = runner.tournaments.work_of(row)
    work.mkdir()
    (work / "seats.json").write_text(json.dumps({f"seat {seat}": seat for seat in seats}))
    runner.tournaments.change("over")
    return row


def test_tournaments_in_which_it_has_played_are_deleted(runner: TournamentRunner) -> None:
    tournaments = runner.tournaments
    others, hers = played(runner, 2, 3), played(runner, 1, 2)
    asyncio.run(runner.delete(1))
    assert [row.id for row in tournaments.all()] == [others.id]
    assert tournaments.work_of(others).is_dir()
    assert not tournaments.folder_of(hers).exists()
    assert not tournaments.work_of(hers).exists()
    for _ in range(2):
        assert tournaments.now is None  # that of before does not come back
        runner.read()


def test_nothing_is_deleted_while_a_tournament_is_played(runner: TournamentRunner) -> None:
    row = played(runner, 1, 2)
    runner.tournaments.change("running")
    with pytest.raises(CommandError, match="A tournament is played now"):
        asyncio.run(runner.delete(1))
    assert runner.tournaments.work_of(row).is_dir()
