"""Practice for rewards over the panel's socket, and the network that drives meanwhile."""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks import NeuralNetController
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.recording import Episode
from ai4u_edu.teach import learning, networks
from ai4u_edu.teach.practice import Practice, PracticeFolder, PracticeProcess, PracticeRequest
from tests.page.panel.rooms import PanelPage, PanelRoom
from tests.playing import Played, played
from tests.processes import children_that_run
from tests.teach.driving import teaching_room
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

BLOCK = """
from ai4u_edu import RewardFunc

class Lamp(RewardFunc):
    calls = 0

    def on_update(self, body, view):
        Lamp.calls += 1
        if Lamp.calls > 40:
            {body}
        return 0.0
"""
"""A reward that fails once an episode is under way."""
SOON = 256
"""Decisions of the shortest practice."""
LATE = 1_000_000
AWAY = {"touch": -1.0}
"""Factors with which a practice never reaches the goal, so that it does not end early."""
PUSHING, LEARNED = "LocalBrain(PushOutController)", "LocalBrain(NeuralNetController)"


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as opened:
        opened.part("teach", lambda part: part["rewards"])
        yield opened


def controller(room: PanelRoom) -> NeuralNetController | None:
    """Return the network's controller that drives; None if something else does."""
    found = getattr(room.runner.sim.agents[0].brain, "controller", None)
    return found if isinstance(found, NeuralNetController) else None


def orange_of(folder: Path, number: int) -> str:
    """Return who drove orange in the first replay of a network's practice in sumo."""
    file = folder / "networks" / f"sumo-{number}.replays" / "000000000.episode"
    return next(agent.driver for agent in Episode.load(file).agents if agent.id == "orange")


def practising(server: psutil.Process) -> list[psutil.Process]:
    """Return the processes of a server that practise."""
    return children_that_run("ai4u_edu.teach.practice_process", server)


def test_a_network_practises_and_drives_then(room: PanelRoom, page: PanelPage) -> None:
    assert page.parts["teach"]["rewards"] == ["touch", "fall", "min_dist"]
    page.done("teach_practise", steps=SOON, weights={"touch": 1, "fall": 2})
    part = page.part("teach", lambda part: part["networks"] and part["networks"][0]["is_driving"])
    assert part["practice"]["phase"] == "over"
    assert part["practice"]["problem"] == ""
    assert part["practice"]["decisions"] >= SOON
    assert len(part["practice"]["rewards"]) == 1
    network = part["networks"][0]
    assert "practised for" in network["how"]
    assert network["facts"][0] == "Rewards: fall times 2, all others as in the scene."
    assert network["made_at"] > 0
    first, last = network["replays"]  # it was too short for eleven
    assert (first, last) == (0, part["practice"]["decisions"])
    for decisions in (first, last, first):
        page.done("teach_replay", network=1, decisions=decisions)
        page.done("back_to_live")
    page.show("0", "past")
    past = page.part("past", lambda part: len(part.get("episodes") or ()) >= 2)
    assert [each["source"] for each in past["episodes"]].count("network 1 after 0 decisions") == 1
    page.show("0", "teach")
    assert "not kept" in page.failed("teach_replay", network=1, decisions=7)["text"]
    assert room.editor.driver_of("0").startswith(NETWORK)
    page.done("teach_practise", steps=SOON, weights={}, begin_with=1)
    page.part("teach", lambda part: len(part["networks"]) == 2)


def test_the_network_of_the_moment_drives_until_it_is_stopped(
    room: PanelRoom, page: PanelPage
) -> None:
    page.done("teach_practise", steps=LATE, weights=AWAY)
    until(lambda: controller(room) is not None)
    driving = controller(room)
    assert driving is not None
    first = driving.network
    until(lambda: driving.network is not first)  # it drives with what it has learned since
    assert "learns already" in page.failed("teach_practise", steps=SOON, weights={})["text"]
    page.done("teach_stop_practising")
    part = page.part("teach", lambda part: part["practice"] and part["practice"]["phase"] == "over")
    assert part["practice"]["problem"] == learning.STOPPED
    assert room.editor.undo_label in ("", "0: driven by network:box_chase-1.onnx")


def test_a_killed_practice_keeps_what_the_world_has(room: PanelRoom, page: PanelPage) -> None:
    page.done("teach_practise", steps=LATE, weights=AWAY)
    part = page.part("teach", lambda part: part["practice"] and part["practice"]["rewards"])
    checks, score = len(part["practice"]["rewards"]), max(part["practice"]["rewards"])
    (process,) = practising(psutil.Process())
    process.kill()
    part = page.part("teach", lambda part: part["practice"] and part["practice"]["phase"] == "over")
    assert part["practice"]["problem"] == learning.DIED
    assert len(part["practice"]["rewards"]) >= checks
    assert max(part["practice"]["rewards"]) >= score
    # the best network until then is kept, and can be begun with
    part = page.part("teach", lambda part: len(part["networks"]) == 1)
    assert "practised for" in part["networks"][0]["how"]
    room.runner.step_decision("0").result()
    assert not room.runner.error


def test_a_paused_practice_goes_on(room: PanelRoom, page: PanelPage) -> None:
    assert page.done("teach_pause")["text"] == "Nothing practises now."
    assert "no practice that could go on" in page.failed("teach_go_on")["text"]
    page.done("teach_practise", steps=LATE, weights=AWAY)
    page.part("teach", lambda part: part["practice"] and part["practice"]["decisions"] > 0)
    page.done("teach_pause")
    part = page.part("teach", lambda part: part["practice"]["phase"] == "paused")
    before = part["practice"]["decisions"]
    assert "a practice is paused" in page.failed("teach_practise", steps=SOON, weights={})["text"]
    page.done("teach_go_on")
    part = page.part("teach", lambda part: part["practice"]["decisions"] > before)
    assert part["practice"]["phase"] == "running"
    page.done("teach_pause")
    page.part("teach", lambda part: part["practice"]["phase"] == "paused")
    page.done("teach_stop_practising")
    part = page.part("teach", lambda part: part["practice"]["phase"] == "over")
    assert part["practice"]["problem"] == learning.STOPPED
    assert part["practice"]["hint"] == ""
    assert room.editor.work_folder is not None
    assert not list((room.editor.work_folder / "practices").glob("*"))


def test_a_saved_practice_of_an_earlier_form_keeps_its_best_network(
    room: PanelRoom, page: PanelPage
) -> None:
    page.done("teach_practise", steps=LATE, weights=AWAY)
    page.part("teach", lambda part: part["practice"] and part["practice"]["rewards"])
    page.done("teach_pause")
    page.part("teach", lambda part: part["practice"]["phase"] == "paused")
    assert room.editor.work_folder is not None
    (state,) = (room.editor.work_folder / "practices").glob("*/run/state.npz")
    with np.load(state) as file:
        arrays = {name: file[name] for name in file.files if name != "key_actions"}
    np.savez(state, **arrays)
    page.done("teach_go_on")
    part = page.part("teach", lambda part: part["practice"]["phase"] == "over")
    assert "expected a saved training of this agent" in part["practice"]["problem"]
    page.part("teach", lambda part: len(part["networks"]) == 1)


def test_a_practice_goes_on_in_its_scene_though_the_robot_is_gone(
    room: PanelRoom, page: PanelPage
) -> None:
    page.done("teach_practise", steps=LATE, weights=AWAY)
    page.part("teach", lambda part: part["practice"] and part["practice"]["decisions"] > 0)
    room.editor.open(Scene.load("soccer")).result()
    # what is paused before the tab has looked at another scene waits for its own
    part = page.part("teach", lambda part: "goal" in part["rewards"])
    assert part["practice"]["elsewhere"] == "robot of “Box chase”"
    before = part["practice"]["decisions"]
    page.part("teach", lambda part: part["practice"]["decisions"] > before)
    page.done("teach_pause")
    page.part("teach", lambda part: part["practice"]["phase"] == "paused")
    room.editor.remove_block("blue_striker", ("rewards", 0)).result()
    part = page.part("teach", lambda part: "goal" not in part["rewards"])
    assert part["practice"], "what was paused here is still offered when the tab looks again"
    room.editor.open(Scene.load("box_chase")).result()
    part = page.part("teach", lambda part: part["practice"] and not part["practice"]["elsewhere"])
    assert part["practice"]["phase"] == "paused"
    assert not part["practice"]["is_scene_changed"]
    room.editor.remove_block("0", ("sensors", 0)).result()
    part = page.part("teach", lambda part: part["practice"]["is_scene_changed"])
    page.done("teach_go_on")
    page.part("teach", lambda part: part["practice"]["decisions"] > before)
    room.runner.step_decision("0").result()
    assert not room.runner.error


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        ("raise KeyError('lamp')", "Lamp 'lamp' of agent '0' failed: KeyError: 'lamp' (lamp.py"),
        ("any(0 for _ in iter(int, 1))", "has not answered for"),
    ],
)
def test_a_block_that_fails_or_hangs_is_named(tmp_path: Path, body: str, problem: str) -> None:
    file = tmp_path / "lamp.py"
    file.write_text(BLOCK.format(body=body))
    load_blocks(file)
    text = Scene.load("box_chase").dumps()
    scene = Scene.loads(text.replace("\n    rewards:\n", "\n    rewards:\n      - type: Lamp\n"))
    ends: list[Practice] = []
    request = PracticeRequest(scene.dumps(), "box_chase", "", "0", SOON, 0, {})
    folder, request = PracticeFolder(tmp_path / "practices").add("box_chase", request)
    practice = Practice(
        folder,
        request,
        start=lambda _, given: PracticeProcess(given),
        on_progress=lambda _: None,
        on_end=ends.append,
    )
    practice.go_on()
    until(lambda: ends)
    assert problem in practice.problem


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL, and the state folder of XDG")
def test_a_practice_goes_on_after_its_server_was_killed(tmp_path: Path) -> None:
    def panel(server: Played) -> PanelPage:
        return PanelPage(server.url.replace("http", "ws", 1) + "ws/panel")

    with played("box_chase", "--seed", "1", state=tmp_path) as server, panel(server) as page:
        page.part("teach", lambda part: part["rewards"])
        page.done("teach_practise", steps=LATE, weights=AWAY)
        part = page.part("teach", lambda part: part["practice"] and part["practice"]["rewards"])
        seen, checks = part["practice"]["decisions"], len(part["practice"]["rewards"])
        (learner,) = practising(psutil.Process(server.process.pid))
        server.process.kill()
        psutil.wait_procs([learner], LIMIT_S)
    with played("box_chase", "--seed", "2", state=tmp_path) as server, panel(server) as page:
        part = page.part("teach", lambda part: part["practice"])
        assert part["practice"]["phase"] == "paused"
        before = part["practice"]["decisions"]
        assert before >= seen
        assert len(part["practice"]["rewards"]) >= checks
        page.done("teach_go_on")
        page.part("teach", lambda part: part["practice"]["decisions"] > before)
        page.done("teach_stop_practising")
        page.part("teach", lambda part: part["practice"]["phase"] == "over")


def test_factors_become_the_scenes_own(room: PanelRoom, page: PanelPage) -> None:
    assert "all factors are 1" in page.failed("teach_put_rewards", weights={"touch": 1})["text"]
    page.done("teach_put_rewards", weights={"touch": 0.5, "min_dist": 3})
    text = room.editor.text()
    assert "reward: 50.0" in text
    assert "success_reward: 0.03" in text
    assert "step_reward: -0.003" in text
    assert "no reward 'luck'" in page.failed("teach_put_rewards", weights={"luck": 2})["text"]
    assert "ends the episode" in page.failed("teach_put_rewards", weights={"touch": 0})["text"]
    room.editor.undo().result()
    assert room.editor.is_as_opened


def test_a_practice_that_can_not_begin_says_why(page: PanelPage) -> None:
    answer = page.failed("teach_practise", steps=SOON, weights={"luck": 1})
    assert "expected reward terms of touch, fall, min_dist, got ['luck']" in answer["text"]
    page.failed("teach_practise", steps=1, weights={})
    page.failed("teach_practise", steps=SOON, weights={"touch": 10_000})
    assert (
        "no network 7"
        in page.failed("teach_practise", steps=SOON, weights={}, begin_with=7)["text"]
    )
    assert page.done("teach_stop_practising")["text"] == "Nothing practises now."


def test_a_scene_with_one_side_offers_no_opponent(page: PanelPage) -> None:
    assert page.parts["teach"]["opponents"] == []
    answer = page.failed("teach_practise", steps=SOON, weights={}, against="self")
    assert "nobody can play against this robot in that way" in answer["text"]


def test_a_network_practises_against_the_scenes_player_itself_and_a_network(tmp_path: Path) -> None:
    with teaching_room(tmp_path, "sumo") as room, room.page() as page:
        part = page.part("teach", lambda part: part["rewards"])
        assert part["opponents"] == ["player", "self", "file"]
        page.done("teach_practise", steps=SOON, weights={}, against="player")
        page.part("teach", lambda part: len(part["networks"]) == 1)
        page.done("teach_practise", steps=SOON, weights={}, against="self")
        part = page.part("teach", lambda part: len(part["networks"]) == 2)
        assert part["practice"]["problem"] == ""
        assert "against itself" in part["networks"][0]["how"]
        assert "against the scene's player" in part["networks"][1]["how"]
        assert [orange_of(tmp_path, number) for number in (1, 2)] == [PUSHING, LEARNED]
        answer = page.failed("teach_practise", steps=SOON, weights={}, against="file")
        assert "expected the network to play against" in answer["text"]
        page.done("teach_practise", steps=SOON, weights={}, against="file", opponent=2)
        part = page.part("teach", lambda part: len(part["networks"]) == 3)
        assert "against Network 2" in part["networks"][0]["how"]
        assert orange_of(tmp_path, 3) == LEARNED


def test_whoever_has_taken_over_goes_on_driving(room: PanelRoom, page: PanelPage) -> None:
    page.done("teach_practise", steps=LATE, weights=AWAY)
    until(lambda: controller(room) is not None)
    page.part("teach", lambda p: p["practice"] and p["practice"]["rewards"])
    room.editor.set_driver("0", "brain:0").result()
    page.done("teach_stop_practising")
    page.part("teach", lambda part: part["networks"])
    assert room.editor.driver_of("0") == "brain:0"


def test_a_network_that_can_not_be_kept_is_spoken_of(
    room: PanelRoom, page: PanelPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(networks, "MAX_NETWORKS", 0)
    page.done("teach_practise", steps=SOON, weights={})
    part = page.part("teach", lambda part: part["warning"])
    assert "The network could not be kept: expected at most 0 networks" in part["warning"]
