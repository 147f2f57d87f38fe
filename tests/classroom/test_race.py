"""A race in a real class: results are replayed, a forged one is refused, and ghosts go round."""

import asyncio
import io
import math
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.classroom.episode_check import Claim, EpisodeCheck, find_fault
from ai4u_edu.classroom.teacher import MAX_COUNTDOWN_S
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.recording.episode import decode, encode
from ai4u_edu.wire.class_link import Ack, Assignment, CurrentRace, EpisodeResult, race_assignment
from tests.classroom.link_client import RawLink, TeacherSocket, key
from tests.classroom.served_class import ServedClass, served_class
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.slow
SEED = 11


def driven(speed: float, seed: int = SEED, reward: float | None = None) -> Episode:
    """Return the recorded episode of a robot that drives to the box."""
    scene = Scene.load("box_chase")
    sim = scene.build()
    robot, box = sim.agents[0], sim.world["box"]

    def steer(_percept: Any) -> dict[str, list[float]]:
        (x, y), (a, b) = robot.body.position, box.position
        turn = math.remainder(robot.body.heading - math.atan2(b - y, a - x), math.tau)
        return {"move": [speed, max(-1.0, min(1.0, turn)), 0, 0]}

    robot.use_brain(LocalBrain(controller=steer))
    recorder = Recorder(sim)
    sim.reset(seed=seed)
    while not robot.done:
        sim.step()
    recorder.finish()
    episode = recorder.episodes[-1]
    assert episode.success
    return episode


def result(
    race: str, episode: Episode, *, seconds: float | None = None, seed: int = SEED
) -> EpisodeResult:
    outcome: Literal["goal"] = "goal"
    took = episode.seconds if seconds is None else seconds
    return EpisodeResult(
        key(), "Box chase", seed, outcome, took, 1.0, "A person", race, encode(episode)
    )


def fell(race: str) -> EpisodeResult:
    return EpisodeResult(key(), "Box chase", SEED, "fell", 1.5, 0.0, "A person", race)


@pytest.fixture(scope="module")
def fast() -> Episode:
    return driven(1.0)


@pytest.fixture(scope="module")
def slow() -> Episode:
    return driven(0.4)


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def claim(recorded: Episode, **changes: Any) -> Claim:
    plain: dict[str, Any] = {
        "episode": encode(recorded),
        "scene": "box_chase",
        "seed": SEED,
        "outcome": "goal",
        "seconds": recorded.seconds,
    }
    return Claim(**(plain | changes))


def test_an_episode_that_replays_to_its_claim_is_right(fast: Episode) -> None:
    assert find_fault(claim(fast)) == ""


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"seconds": 0.5}, "expected 0.50 s, got"),
        ({"seed": 12}, "expected seed 12, got 11"),
        ({"outcome": "won"}, "got 'goal' in the replay"),
        ({"scene": "maze"}, "another scene"),
        ({"episode": b""}, "expected a recorded episode"),
        ({"episode": b"ai4u-edu episode 1\nxx"}, "damaged"),
    ],
)
def test_a_claim_that_is_wrong_is_told(fast: Episode, changes: dict[str, Any], fault: str) -> None:
    assert fault in find_fault(claim(fast, **changes))


ENDLESS = """
from gymnasium.spaces import Box
from ai4u_edu import Sensor
from ai4u_edu.classroom import episode_check

class Luck(Sensor):
    def space(self):
        return Box(0, 1, (1,))

    def read(self, body, view):
        return 0.5

find_fault = episode_check.find_fault

def endless(claim):
    while claim.seed == 0:
        pass
    return find_fault(claim)

episode_check.find_fault = endless
"""


def test_a_check_that_never_ends_is_refused_and_the_next_one_runs(
    fast: Episode, tmp_path: Path
) -> None:
    blocks = tmp_path / "blocks.py"
    blocks.write_text(ENDLESS)
    check = EpisodeCheck([blocks], max_cpu_s=0.1)
    try:
        fault = asyncio.run(check.find_fault(claim(fast, seed=0)))
        assert fault == "it could not be replayed in 0.1 s of processor time"
        check.max_cpu_s = LIMIT_S
        assert asyncio.run(check.find_fault(claim(fast))) == ""
    finally:
        check.close()


def test_an_episode_that_is_not_whole_is_refused(fast: Episode) -> None:
    plain = encode(fast)
    data = bytearray(plain)
    episode = decode(Episode, bytes(data), "it")
    episode.agents[0].worlds[3] += 1  # a checksum of another world
    assert "other places" in find_fault(claim(fast, episode=encode(episode)))


def test_another_success_does_not_help(fast: Episode) -> None:
    """The scene within an episode may name another reward as its success; the race's counts."""
    text = Scene.load("box_chase").source.replace("success: touch", "success: fall")
    assert find_fault(claim(fast, scene=text, outcome="goal")) != ""


def test_a_race_from_start_to_end(served: ServedClass, fast: Episode, slow: Episode) -> None:
    ada, ben = served.joined(name="Red Fox"), served.joined(name="Blue Otter")
    with RawLink(served, ada) as one, RawLink(served, ben) as two, TeacherSocket(served) as wall:
        body = {"scene": "box_chase", "seed": SEED}
        assert served.command("race", **body, countdown=MAX_COUNTDOWN_S).status_code == 200
        first = one.next(CurrentRace, lambda message: message.id != "")
        assert (first.phase, first.scene, first.seed) == ("countdown", "box_chase", SEED)
        assert 0 < first.starts_in_s <= MAX_COUNTDOWN_S
        # another one, whose countdown may be over before a link is told of it
        assert served.command("race", **body, countdown=0.2).status_code == 200
        race = one.next(CurrentRace, lambda message: message.phase == "running")
        assert race.id == two.next(CurrentRace, lambda m: m.phase == "running").id != first.id

        sent = result(race.id, slow)
        one.send(sent)
        assert one.next(Ack).key == sent.key
        two.send(result(race.id, fast))
        forged = result(race.id, fast, seconds=0.5)
        two.send(forged)
        told = wall.next("class", lambda e: e["race"] and len(e["race"]["board"]) == 3)
        board = told["race"]["board"]
        assert [each["name"] for each in board] == ["Blue Otter", "Red Fox", "Blue Otter"]
        assert [each["outcome"] for each in board] == ["goal", "goal", "refused"]
        assert "0.50 s" in board[2]["why"]

        news = one.next(CurrentRace, lambda message: len(message.ghosts) == 2)
        assert [each.name for each in news.board] == ["Blue Otter", "Red Fox"]
        assert news.board[0].seconds == pytest.approx(fast.seconds)
        assert decode(Episode, news.ghosts[0], "ghost").seconds == fast.seconds

        two.send(fell(race.id))  # it changes nothing of a room that has arrived
        with RawLink(served, served.joined(name="Calm Owl")) as late_one:
            assigned = late_one.next(Assignment, lambda message: message.id != "")
            assert (assigned.id, assigned.scene) == (race_assignment(race.id), "box_chase")
            assert late_one.next(CurrentRace, lambda message: message.id == race.id).own_best == 0
            end = fell(race.id)
            late_one.send(end)
            late_one.next(Ack, lambda message: message.key == end.key)
        with RawLink(served, ada) as one:  # as after a restart
            again = one.next(CurrentRace, lambda message: message.id == race.id)
            assert again.own_best == pytest.approx(slow.seconds)
            one.next(CurrentRace, lambda message: len(message.board) == 3)
            with zipfile.ZipFile(io.BytesIO(served.export())) as archive:
                page = archive.read("results.html").decode()
            assert "<td>3</td><td>Calm Owl</td>" not in page
            assert "<td></td><td>Calm Owl</td><td>fell</td>" in page

        one = RawLink(served, ada)
        assert served.command("board", hide=True).status_code == 200
        assert one.next(CurrentRace, lambda message: message.board == ()).phase == "running"
        with TeacherSocket(served, "projector") as projector:
            assert projector.next("class")["race"]["board"] == []
        assert served.command("end race").status_code == 200
        assert one.next(CurrentRace, lambda message: message.phase == "over").id == race.id
        assert served.command("end race").status_code == 200
        assert one.next(CurrentRace, lambda message: message.id == "").phase == "over"
        late = result(race.id, fast)
        two.send(late)
        two.next(Ack, lambda message: message.key == late.key)


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        ({"scene": "nowhere"}, "expected a scene of the library"),
        ({"scene": {"yaml": "bodies: 3"}}, "scene: "),
        ({"scene": {"room": "../.."}}, "there is no room"),
        ({"scene": "maze", "seed": -1}, "seed"),
        ({"scene": "maze", "countdown": 1e9}, "countdown"),
    ],
)
def test_a_race_that_can_not_be_is_a_sentence(
    served: ServedClass, body: dict[str, Any], problem: str
) -> None:
    answer = served.command("race", **body)
    assert answer.status_code == 400
    assert problem in answer.json()["problem"]
