"""Teaching over the panel's socket: from drives to a network that drives."""

import base64
import json
import math
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import msgspec
import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.recording import Episode
from ai4u_edu.teach import learning, scene_work
from ai4u_edu.teach.drives import DriveFolder
from ai4u_edu.teach.messages import TeachPart
from ai4u_edu.teach.scene_work import reason_against_teaching
from tests.page.panel.rooms import Message, PanelPage, PanelRoom
from tests.processes import children_that_run
from tests.teach.driving import SEEDS, drive, steer, teaching_room
from tests.waiting import until

pytestmark = pytest.mark.slow

SENSORS = ("RayCastingSensor", "OrientationSensor", "ActionSensor")


@pytest.fixture(scope="module")
def episodes() -> list[Episode]:
    return [drive(seed) for seed in SEEDS]


@pytest.fixture
def work(tmp_path: Path, episodes: list[Episode]) -> Path:
    folder = DriveFolder(tmp_path / "drives")
    for episode in episodes:
        folder.add(episode)
    return tmp_path


@pytest.fixture
def room(work: Path) -> Iterator[PanelRoom]:
    with teaching_room(work) as served:
        yield served


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as opened:
        opened.part("teach", lambda part: part["drives"])
        yield opened


def learned(page: PanelPage, *drives: int) -> Message:
    """Learn, and return the part when the network drives."""
    before = len(page.parts["teach"]["networks"])
    page.done("teach_learn", drives=list(drives))
    return page.part(
        "teach",
        lambda part: len(part["networks"]) > before and part["networks"][0]["is_driving"],
    )


def test_a_network_learns_from_drives_and_then_drives(room: PanelRoom, page: PanelPage) -> None:
    drives = page.parts["teach"]["drives"]
    assert [each["number"] for each in drives] == [*reversed(SEEDS)]
    assert all(each["result"] and not each["reason"] for each in drives)
    msgspec.convert(page.parts["teach"], TeachPart)
    part = learned(page, *SEEDS)
    state = part["learning"]
    assert state["is_over"]
    assert state["problem"] == ""
    assert state["alike"] > 0.6
    assert state["alike"] > state["commonest"]
    assert state["errors"][0] > state["errors"][-1]
    assert part["networks"][0]["title"] == "Network 1"
    assert room.editor.driver_of("0").startswith(NETWORK)
    assert room.editor.is_as_opened  # the scene is as it was
    file = page.done("teach_download", network=1)
    (kept,) = (room.editor.work_folder / "networks").glob("*.onnx")  # type: ignore[operator]
    assert (file["name"], base64.b64decode(file["data"])) == (kept.name, kept.read_bytes())


def test_what_was_learned_in_another_scene_is_not_shown(room: PanelRoom, page: PanelPage) -> None:
    learned(page, *SEEDS)
    room.editor.open(Scene.load("box_chase_ai4u")).result()
    page.part("teach", drives=[], learning=None)


def test_the_network_reaches_the_goal_where_nobody_drove(room: PanelRoom, page: PanelPage) -> None:
    learned(page, *SEEDS)
    brain = room.editor.driver_brain("0", room.editor.driver_of("0"))
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(brain)
    reached = 0
    for seed in range(100, 108):
        sim.reset(seed)
        for _ in range(400):
            sim.step()
            if sim.agents[0].done:
                break
        reached += sim.agents[0].done and sim.agents[0].ledger.terms.get("touch", 0.0) > 0
    assert reached >= 4


def test_the_same_drives_give_the_same_network(room: PanelRoom, page: PanelPage) -> None:
    for _ in range(2):
        learned(page, 1, 2)
    files = sorted((room.editor.work_folder / "networks").glob("*.onnx"))  # type: ignore[operator]
    assert len(files) == 2
    assert files[0].read_bytes() == files[1].read_bytes()


def test_a_person_and_a_network_can_take_turns(room: PanelRoom, page: PanelPage) -> None:
    learned(page, 1, 2)
    room.editor.set_driver("0", "brain:0").result()
    page.part("teach", lambda part: not part["networks"][0]["is_driving"])
    page.done("teach_drive", network=1)
    page.part("teach", lambda part: part["networks"][0]["is_driving"])
    assert "drives an agent" in page.failed("teach_delete", network=1)["text"]
    room.editor.set_driver("0", "brain:0").result()
    page.done("teach_rename", network=1, title="Racer")
    page.part("teach", lambda part: part["networks"][0]["title"] == "Racer")
    names = [driver.title for driver in room.editor.drivers("0")]
    assert "Network Racer" in names
    page.done("teach_delete", network=1)
    assert page.part("teach", networks=[])
    assert "no network 1" in page.failed("teach_drive", network=1)["text"]


def test_a_command_that_is_wrong_is_a_sentence(page: PanelPage) -> None:
    assert "expected drives that this robot" in page.failed("teach_learn", drives=[99])["text"]
    page.failed("teach_learn", drives=[])
    page.failed("teach_learn", drives=["x"])
    page.failed("teach_rename", network=1, title="x")
    page.failed("teach_download", network=1)
    assert page.done("teach_stop")["text"] == "Nothing learns now."


def test_a_deleted_drive_is_gone(page: PanelPage, work: Path) -> None:
    page.done("teach_forget_drive", drive=3)
    page.part("teach", lambda part: 3 not in [each["number"] for each in part["drives"]])
    assert not (work / "drives" / "box_chase-3.episode").exists()


def child() -> psutil.Process:
    """Return the process that learns."""
    found: list[psutil.Process] = []

    def is_there() -> bool:
        found[:] = children_that_run("ai4u_edu.teach.clone_process")
        return bool(found)

    until(is_there)
    return found[0]


def test_learning_can_be_stopped_and_begun_again(page: PanelPage) -> None:
    page.done("teach_learn", drives=[*SEEDS])
    process = child()
    os.kill(process.pid, signal.SIGSTOP)  # so that it is not over before
    assert "learns already" in page.failed("teach_learn", drives=[1])["text"]
    page.done("teach_stop")
    part = page.part("teach", lambda part: part["learning"] and part["learning"]["is_over"])
    assert part["learning"]["problem"] == learning.STOPPED
    assert part["networks"] == []
    assert learned(page, 1)["learning"]["remarks"]  # of one drive only


def test_a_killed_process_is_told_of(page: PanelPage) -> None:
    page.done("teach_learn", drives=[*SEEDS])
    child().kill()
    part = page.part("teach", lambda part: part["learning"] and part["learning"]["is_over"])
    assert part["learning"]["problem"] == learning.DIED


def test_a_drive_is_kept_as_soon_as_it_ends(tmp_path: Path) -> None:
    with teaching_room(tmp_path) as room, room.page() as page:
        page.part("teach", drives=[])
        runner = room.runner
        runner.reset(1).result()
        while not runner.sim.agents[0].done:
            steer(runner.sim)
            runner.step_decision("0").result()
        part = page.part("teach", lambda part: part["drives"])
        assert part["drives"][0]["number"] == 1
        assert (tmp_path / "drives" / "box_chase-1.episode").is_file()


def test_a_lost_game_is_one_drive_that_did_not_reach_the_goal(tmp_path: Path) -> None:
    with teaching_room(tmp_path, "sumo") as room, room.page() as page:
        page.part("teach", drives=[])
        runner = room.runner
        runner.reset(1).result()
        blue = runner.sim.agents[0]
        blue.keyboard.clock = lambda: 0.0  # keys stay held until others are
        blue.keyboard.hold(["KeyS"])
        while not blue.done:
            runner.step_decision("blue").result()
        part = page.part("teach", lambda part: part["drives"])
        assert [drive["result"] for drive in part["drives"]] == [False]
        assert len(list((tmp_path / "drives").iterdir())) == 1


def test_a_drive_that_can_not_be_kept_is_told_of(tmp_path: Path) -> None:
    (tmp_path / "drives").write_text("in the way")
    with teaching_room(tmp_path) as room, room.page() as page:
        page.part("teach")
        assert room.runner.recorder is not None
        for listener in room.runner.recorder.done_listeners:
            listener(drive(1))
        part = page.part("teach", lambda part: part["warning"])
        assert "could not be kept" in part["warning"]


def test_without_a_work_folder_there_is_no_tab() -> None:
    with teaching_room(None) as room, room.page() as page:
        page.part("run")
        assert (
            "no command is called 'teach_learn'" in page.failed("teach_learn", drives=[1])["text"]
        )
        assert "teach" not in json.dumps(page.parts.get("tabs", {}))


def test_an_agent_that_can_not_be_taught_has_a_reason() -> None:
    def reason(*changes: tuple[str, str]) -> str:
        text = Scene.load("box_chase").dumps()
        for before, after in changes:
            assert before in text
            text = text.replace(before, after)
        sim = Scene.loads(text).build()
        sim.reset(0)
        return reason_against_teaching(sim.agents[0])

    assert reason() == ""
    blind = [(f"- type: {each}", f"- is_input: false\n        type: {each}") for each in SENSORS]
    assert reason(*blind) == scene_work.NO_SENSOR
    free = ("- type: RBMoveActuator", "- is_output: false\n        type: RBMoveActuator")
    assert reason(free) == scene_work.NO_ACTUATOR
    soccer = Scene.load("soccer").build()
    soccer.reset(0)
    assert {reason_against_teaching(agent) for agent in soccer.agents} == {""}


def test_numbers_that_are_not_finite_end_a_learning_with_a_sentence(
    work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = msgspec.json.encode(learning.CloneNote(1, math.nan)).decode()  # JSON has null for it

    def start(_module: str) -> "subprocess.Popen[bytes]":
        program = f"import sys; sys.stdin.read(); print({text!r}, flush=True); input()"
        command, pipe = [sys.executable, "-c", program], subprocess.PIPE
        return subprocess.Popen(command, stdin=pipe, stdout=pipe)

    monkeypatch.setattr(learning, "start_process", start)
    drives = sorted((work / "drives").glob("*.episode"))
    learns = learning.Learning(drives, "0", seed=0, on_done=lambda *_: None)
    until(lambda: not learns.is_running)
    assert learns.note.problem == learning.NOT_FINITE
    assert learns.is_over
