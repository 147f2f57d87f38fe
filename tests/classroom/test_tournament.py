"""A tournament of a class: hand in, check, play, watch, export, forget; also after a crash."""

import asyncio
import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import onnx
import psutil
import pytest

from ai4u_edu.blocks.brains import zoo
from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.errors import CommandError
from ai4u_edu.classroom.tournament.event import networks_event
from ai4u_edu.classroom.tournament.network_check import missing_extras
from ai4u_edu.classroom.tournament.runner import TournamentRunner
from ai4u_edu.classroom.tournament.tournaments import TournamentRow, Tournaments
from ai4u_edu.games.jobs import engine
from ai4u_edu.games.tournament.verify import verify
from ai4u_edu.member.my_work import open_my_work
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES, Ack, HandedIn, HandedInNetwork, LinkProblem
from tests.classroom.link_client import RawLink, TeacherSocket, key, wait_for_verdicts
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.test_export import found_in, zip_of
from tests.games.tournament.bad_networks import BAD, INPUTS, few_outputs
from tests.learn.training.networks import network
from tests.page.server import http_client
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.needs("train", "tournament")

OCTETS = {"Content-Type": "application/octet-stream"}


def hand_in(student: Student, data: bytes, **changes: str) -> httpx.Response:
    place = {"scene": "sumo", "part": "", "file": "policy.onnx"} | changes
    return student.client.put("api/network", params=place, content=data, headers=OCTETS)


def verdicts(served: ServedClass, student: Student) -> list[tuple[str, str]]:
    """Return file and verdict of a student's networks, when all were checked."""
    wait_for_verdicts(served, student)
    answer = student.client.get("api/network")
    assert answer.status_code == 200, answer.text
    found = answer.json()["networks"]
    return [(each["file"], each["reason"] or each["verdict"]) for each in found]


def tournament(served: ServedClass, fits: Callable[[dict[str, Any]], Any]) -> dict[str, Any]:
    """Return the tournament on the teacher's page, as soon as it fits."""
    with TeacherSocket(served) as wall:
        event = wall.next("class", lambda each: each["tournament"] and fits(each["tournament"]))
    found: dict[str, Any] = event["tournament"]
    return found


def is_over(found: dict[str, Any]) -> bool:
    assert found["phase"] != "failed", found["problem"]
    return bool(found["phase"] == "over")


@pytest.fixture
def good(tmp_path: Path) -> bytes:
    return network(tmp_path / "good.onnx", INPUTS).read_bytes()


@pytest.mark.slow
@pytest.mark.nightly
def test_networks_are_handed_in_checked_played_exported_and_forgotten(
    tmp_path: Path, good: bytes
) -> None:
    folder, bad = tmp_path / "class", tmp_path / "bad.onnx"
    few_outputs(bad)
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        eve = served.joined(name="Calm Owl")
        assert hand_in(ada, good, file="../<b>ada.onnx").status_code == 200
        with RawLink(served, ben) as link:  # as a notebook does
            mine = HandedInNetwork(key(), "sumo", "", "ben.onnx", good)
            link.send(mine)
            link.next(Ack, lambda ack: ack.key == mine.key)
            told = link.next(HandedIn, checked)
            assert (told.networks[0].key, told.networks[0].verdict) == (mine.key, "right")
            link.send(HandedInNetwork(key(), "chess", "", "ben.onnx", good))
            assert "scene: expected one of" in link.next(LinkProblem).text
            link.next(Ack)
        the_gateway_refuses_what_it_need_not_open(served, eve, good)
        assert hand_in(eve, bad.read_bytes(), file="bad.onnx").status_code == 200
        ((file, reason),) = verdicts(served, eve)
        assert (file, BAD[few_outputs] in reason) == ("bad.onnx", True)
        assert verdicts(served, ada) == [("_b_ada.onnx", "right")]

        answer = served.command("start tournament")
        assert (answer.status_code, "no tournament" in answer.text) == (400, True)
        assert served.command("tournament", scene="sumo").status_code == 200
        assert ada.client.get("api/network").json()["scene"] == "sumo"
        told = ada.client.get("api/network", headers={"Accept-Language": "pt-BR"}).json()
        assert "Sumô" in {each["title"] for each in told["scenes"]}
        assert served.command("start tournament", seeds=1).status_code == 200
        answer = served.command("close tournament")
        assert (answer.status_code, "cancel it first" in answer.text) == (400, True)
        done = tournament(served, is_over)
        played_by_two(done)
        everything_is_exported(served, ada, tmp_path, good)
        assert served.command("forget").status_code == 200
        assert found_in(folder, ["Red Fox", "ada.onnx", "ben.onnx", "Blue Otter"]) == []
        assert [each.name for each in folder.iterdir() if each.is_dir()] == []
        assert served.state()["tournament"] is None


def checked(message: HandedIn) -> bool:
    return bool(message.networks) and all(each.verdict != "open" for each in message.networks)


def the_gateway_refuses_what_it_need_not_open(
    served: ServedClass, eve: Student, good: bytes
) -> None:
    assert "at most 5 MB" in hand_in(eve, bytes(MAX_NETWORK_BYTES + 1)).json()["problem"]
    assert "empty" in hand_in(eve, b"").json()["problem"]
    assert "as an .onnx file" in hand_in(eve, good, file="model.zip").json()["problem"]
    assert "scene: expected" in hand_in(eve, good, scene="chess").json()["problem"]
    assert eve.client.put("api/network", json={}).status_code == 415
    evil = eve.client.put("api/network", content=b"x", headers=OCTETS | {"Origin": "http://x.org"})
    assert evil.status_code == 403
    assert hand_in(served.student(), good).status_code == 403
    assert eve.client.get("teacher/tournament/1").status_code == 401
    assert verdicts(served, eve) == []


def played_by_two(done: dict[str, Any]) -> None:
    results = done["results"]
    assert (results["games"], results["total"], done["players"]) == (2, 2, 2)
    assert {each["name"] for each in results["standings"]} == {"Red Fox", "Blue Otter"}
    assert {each["seat"] for each in results["standings"]} == {1, 2}
    assert len(results["latest"]) == 1


def everything_is_exported(served: ServedClass, ada: Student, folder: Path, good: bytes) -> None:
    files = zip_of(served.export())
    assert files["networks/Red Fox 1/sumo.onnx"] == good
    assert not any(name.startswith("networks/Calm Owl") for name in files)
    assert "Tournament: Sumo" in files["results.html"].decode()
    for name, data in files.items():
        if name.startswith("tournaments/1 Sumo/"):
            path = folder / "exported" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
    assert verify(folder / "exported/tournaments/1 Sumo", engine("inline")) == (2, [])
    (folder / "my-work.zip").write_bytes(ada.client.get("api/my-work").content)
    work = open_my_work(folder / "my-work.zip")
    assert (work.folder / "networks/sumo.onnx").read_bytes() == good


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.skipif(os.name == "nt", reason="no SIGKILL")
def test_a_tournament_goes_on_after_the_class_was_killed(tmp_path: Path, good: bytes) -> None:
    folder = tmp_path / "class"
    with served_class(folder) as served:
        ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
        for each in (ada, ben):
            assert hand_in(each, good).status_code == 200
        for each in (ada, ben):
            assert verdicts(served, each) == [("policy.onnx", "right")]
        served.command("tournament", scene="sumo")
        assert served.command("start tournament", seeds=20, own_player=True).status_code == 200
        tournament(served, lambda found: found["results"] and found["results"]["games"] >= 4)
        children = psutil.Process(served.process.pid).children(recursive=True)
        os.kill(served.process.pid, signal.SIGKILL)
        assert psutil.wait_procs(children, LIMIT_S)[1] == []
    with served_class(folder) as served:
        found = tournament(served, lambda found: found["results"] and found["results"]["games"] > 6)
        assert found["phase"] == "running"
        assert served.command("cancel tournament").status_code == 200
        stopped = tournament(served, lambda found: found["phase"] == "cancelled")["results"]
        assert stopped["games"] < stopped["total"] == 6 * 20
    with served_class(folder) as served:
        assert tournament(served, lambda found: found["phase"] == "cancelled")["results"] == stopped
        assert served.command("start tournament", seeds=2, own_player=True).status_code == 200
        results = tournament(served, is_over)["results"]
        assert (results["games"], len(results["standings"])) == (12, 3)
        with TeacherSocket(served, language="pt-BR") as wall:
            found = wall.next("class", lambda each: each["tournament"])["tournament"]["results"]
        assert "O piloto da cena" in {each["name"] for each in found["standings"]}
        games_can_be_watched(served, results["best"][0]["number"])
    with served_class(folder) as served:
        assert tournament(served, is_over)["results"] == results
        assert served.command("start tournament", seeds=20).status_code == 200
        tournament(served, lambda found: found["results"] and found["results"]["games"] >= 6)
        (name,) = {each for each in zip_of(served.export()) if each.endswith("tournament.json")}
        assert name == "tournaments/1 Sumo/tournament.json"
        children = psutil.Process(served.process.pid).children(recursive=True)
        assert served.command("forget").status_code == 200
        assert psutil.wait_procs(children, LIMIT_S)[1] == []
        assert [each.name for each in folder.iterdir() if each.is_dir()] == []
        assert "Fatal" not in "".join(served.told)


def games_can_be_watched(served: ServedClass, number: int) -> None:
    auth = {"Authorization": f"Bearer {served.token}"}
    for path in ("teacher/tournament", f"teacher/tournament/{number}"):
        page = http_client.get(served.url + path, headers=auth)
        assert page.status_code == 200, page.text
        assert "sandbox allow-scripts" in page.headers["content-security-policy"]
        assert "Sumo" in page.text
    absent = f"{served.url}teacher/tournament/999"
    assert http_client.get(absent, headers=auth).status_code == 404


@pytest.mark.slow
@pytest.mark.nightly
def test_networks_that_are_slow_or_strange_are_refused_and_the_class_goes_on(
    tmp_path: Path, good: bytes
) -> None:
    with served_class(tmp_path / "class") as served:
        for make, told in {**BAD, elsewhere: "whose numbers lie in another file"}.items():
            student = served.joined()
            make(tmp_path / f"{make.__name__}.onnx")
            data = (tmp_path / f"{make.__name__}.onnx").read_bytes()
            assert hand_in(student, data, file=f"{make.__name__}.onnx").status_code == 200
            (found,) = verdicts(served, student)
            assert (found[0], told in found[1]) == (f"{make.__name__}.onnx", True), found
            assert str(tmp_path) not in found[1]
        student = served.joined()
        assert hand_in(student, good).status_code == 200
        assert verdicts(served, student) == [("policy.onnx", "right")]


@pytest.mark.slow
def test_a_network_of_another_scene_is_refused_in_words_for_students(tmp_path: Path) -> None:
    with served_class(tmp_path / "class") as served:
        ada = served.joined()
        chases = zoo.network_of("box_chase").read_bytes()
        assert hand_in(ada, chases).status_code == 200
        assert verdicts(served, ada) == [
            (
                "policy.onnx",
                "It was trained in “Box chase”; this tournament is “Sumo”. "
                "Hand in a network that was trained in “Sumo”.",
            )
        ]


def elsewhere(path: Path) -> None:
    """Write a network whose numbers lie in a file outside of its folder."""
    model = onnx.load(network(path, INPUTS))
    weights = model.graph.initializer[1]
    weights.ClearField("raw_data")
    weights.data_location = onnx.TensorProto.EXTERNAL
    entry = weights.external_data.add()
    entry.key, entry.value = "location", "../../../../../../etc/passwd"
    path.write_bytes(model.SerializeToString())


# -- without a served class ------------------------------------------------------------------------


@pytest.fixture
def runner(tmp_path: Path) -> Iterator[TournamentRunner]:
    with ClassStore(tmp_path) as store:
        yield TournamentRunner(store, lambda _: None, lambda: None)


def test_missing_extras_are_a_sentence_for_the_teacher(
    runner: TournamentRunner, monkeypatch: pytest.MonkeyPatch
) -> None:
    asyncio.run(runner.begin("sumo"))
    assert missing_extras() == ""
    monkeypatch.setattr("ai4u_edu.base.optional_deps.find_spec", lambda _: None)
    install = 'pip install "ai4u-edu[tournament]"'
    assert install in networks_event(runner)["missing"]
    with pytest.raises(CommandError) as refused:
        asyncio.run(runner.start([], 1, "round-robin", has_own_player=True))
    assert install in str(refused.value)
    assert runner.tournaments.now is not None
    assert runner.tournaments.now.phase == "open"


def test_one_player_is_no_tournament(runner: TournamentRunner) -> None:
    asyncio.run(runner.begin("sumo"))
    with pytest.raises(CommandError, match="needs two players at least, and 1 can play"):
        asyncio.run(runner.start([], 1, "round-robin", has_own_player=True))
    with pytest.raises(CommandError, match="scene: expected one of the library, got 'chess'"):
        asyncio.run(runner.begin("chess"))


def test_the_present_tournament_is_the_last_one_until_it_is_dismissed(tmp_path: Path) -> None:
    with ClassStore(tmp_path) as store:
        first = Tournaments(store)
        first.begin("sumo", "Sumo")
        first.change("failed", "the disk is full")
        again = Tournaments(store).now
        assert again is not None
        assert (again.title, again.phase, again.problem) == ("Sumo", "failed", "the disk is full")
        first.begin("tag", "Tag")
        first.dismiss()
        assert Tournaments(store).now is None
        assert [each.title for each in first.all()] == ["Sumo", "Tag"]
        assert isinstance(first.all()[0], TournamentRow)
