""" "Try many" over the panel's socket: the driver drives from the same starts with each value."""

import csv
import io
import sys
from collections.abc import Iterator

import psutil
import pytest

from ai4u_edu import Scene
from ai4u_edu.games.jobs import engine
from ai4u_edu.learn.training.varying import parameter_named, try_values, with_driver
from ai4u_edu.teach import background, tries
from ai4u_edu.teach.learning import STOPPED
from ai4u_edu.teach.tasks import MODULES
from tests.page.panel.rooms import PanelPage, PanelRoom
from tests.processes import children_that_run
from tests.waiting import until

pytestmark = pytest.mark.slow

NICENESS = 19
"""Niceness of processes that learn or drive beside a world."""
HOLD_ID = 1_000_000
SPEED, NETWORK = "0.move.move_amount", "network:zoo:box_chase"


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as opened:
        opened.part("tries", lambda part: part["numbers"])
        yield opened


def let_a_network_drive(room: PanelRoom, page: PanelPage) -> None:
    room.editor.set_driver("0", NETWORK).result()
    page.part("tries", lambda part: not part["problem"])


def test_the_results_are_those_of_the_command(room: PanelRoom, page: PanelPage) -> None:
    let_a_network_drive(room, page)
    page.done("teach_try", parameter=SPEED, values="2, 5", starts=3)
    part = page.part("tries", lambda part: part["tries"] and part["tries"]["is_over"])
    state = part["tries"]
    assert (state["problem"], state["done"], state["total"]) == ("", 6, 6)
    assert state["label"] == "move: move amount (m/s)"
    scene, _ = with_driver(Scene.load("box_chase"), "zoo")
    with engine("inline") as running:
        rows = try_values(scene, parameter_named(scene, SPEED), [2, 5], range(3), running)
    assert [(row["value"], row["successes"], row["seconds"]) for row in state["rows"]] == [
        (row.value, row.successes, row.seconds) for row in rows
    ]
    answer = page.done("teach_download_tried")
    assert answer["name"] == f"box_chase-{SPEED}.csv"
    assert [row[SPEED] for row in csv.DictReader(io.StringIO(answer["data"]))] == ["2", "5"]


@pytest.mark.skipif(sys.platform == "win32", reason="there is no niceness")
@pytest.mark.parametrize("module", MODULES.values())
def test_the_world_comes_first(module: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "NICENESS", NICENESS)
    with background.start_process(module) as process:
        until(lambda: psutil.Process(process.pid).nice() == NICENESS)
        process.kill()


def test_it_offers_the_numbers_of_the_robot_and_the_world(page: PanelPage) -> None:
    numbers = {each["name"]: each for each in page.parts["tries"]["numbers"]}
    assert numbers["0.vision.noise"]["owner"] == "vision"
    assert numbers["0.max_steps_per_episode"]["owner"] == "the robot"
    assert numbers["world.gravity"]["label"] == "gravity (m/s^2)"
    assert numbers["bodies.box.mass"]["value"] == 5
    assert "at least 1, at most 256" in numbers["0.vision.rows"]["limits"]


def test_keys_and_programs_can_not_be_tried(room: PanelRoom, page: PanelPage) -> None:
    assert page.parts["tries"]["problem"] == tries.BY_KEYS
    answer = page.failed("teach_try", parameter=SPEED, values="1", starts=1)
    assert answer["text"] == tries.BY_KEYS
    room.editor.set_driver("0", "ai4u://127.0.0.1:8080").result()
    page.part("tries", lambda part: part["problem"] == tries.NO_PROGRAM)


def test_a_mistake_is_explained_before_anything_drives(room: PanelRoom, page: PanelPage) -> None:
    let_a_network_drive(room, page)
    for wrong, sentence in (
        ({"values": "1, two"}, "expected numbers with commas between, as in 1,2,4"),
        ({"values": "-1"}, f"{SPEED} = -1: expected at least 0, got -1"),
        ({"parameter": "0.move.speed"}, "no number of this scene is called '0.move.speed'"),
        ({"parameter": "0.vision.rows", "values": "9"}, "does not fit agent '0'"),
    ):
        words = {"parameter": SPEED, "values": "1", "starts": 1} | wrong
        assert sentence in page.failed("teach_try", **words)["text"]
    page.failed("teach_try", parameter=SPEED, values="1", starts=tries.MAX_STARTS + 1)
    assert "try some values first" in page.failed("teach_download_tried")["text"]
    assert page.done("teach_stop_trying")["text"] == "Nothing is tried now."


def test_what_was_driven_is_kept_when_it_is_stopped_or_dies(
    room: PanelRoom, page: PanelPage
) -> None:
    let_a_network_drive(room, page)
    many = {"parameter": SPEED, "values": "5, 0", "starts": 200}
    page.done("teach_try", **many)
    page.part("tries", lambda part: part["tries"] and part["tries"]["rows"])
    assert "tried already" in page.failed("teach_try", **many)["text"]
    page.done("teach_stop_trying")
    part = page.part("tries", lambda part: part["tries"]["is_over"])
    assert part["tries"]["problem"] == STOPPED
    assert [row["value"] for row in part["tries"]["rows"]] == [5]

    page.done("teach_try", **many)
    (process,) = children_that_run("ai4u_edu.teach.try_process")
    process.kill()
    part = page.part(
        "tries", lambda part: part["tries"]["is_over"] and part["tries"]["problem"] == tries.DIED
    )
    room.runner.step_decision("0").result()
    assert not room.runner.error


def hold(page: PanelPage) -> None:
    """Wait until the tries are over, as a page does whose program drives; send it, and go on."""
    page.send({"type": "do", "id": HOLD_ID, "command": "teach_hold_tries"})


def speed_of(room: PanelRoom) -> float:
    move = room.runner.sim.agents[0].actuators[0]
    return float(getattr(move, "move_amount"))  # noqa: B009 - of this actuator's class


def test_a_pages_program_drives_with_each_value(room: PanelRoom, page: PanelPage) -> None:
    before = speed_of(room)
    assert before not in (2, 4)
    answer = page.done("teach_try_program", parameter=SPEED, values="2, 4", starts=3)
    assert answer["values"] == [2, 4]
    hold(page)
    assert (
        "tried already" in page.failed("teach_try", parameter=SPEED, values="1", starts=1)["text"]
    )
    assert "a value that is to be tried" in page.failed("teach_set_value", value=3)["text"]
    for value in (2, 4):
        page.done("teach_set_value", value=value)
        for seed in (0, None):  # also episodes that begin by themselves
            room.runner.reset(seed).result()
            assert speed_of(room) == value
        means = {"reward": 1.5, "seconds": 2.0, "decisions": 7.0}
        page.done("teach_note_value", value=value, successes=2, **means)
    part = page.part("tries", lambda part: part["tries"] and part["tries"]["is_over"])
    assert (part["tries"]["problem"], part["tries"]["done"]) == ("", 6)
    assert [(row["successes"], row["episodes"]) for row in part["tries"]["rows"]] == [(2, 3)] * 2
    assert 0.2 < part["tries"]["rows"][0]["low"] < 2 / 3
    until(lambda: speed_of(room) == before)
    assert room.runner.sim.usual_options is None
    assert room.editor.is_as_opened
    assert "no values are tried" in page.failed("teach_set_value", value=2)["text"]


@pytest.mark.parametrize("ends", ["the page leaves", "it is stopped"])
def test_the_scene_has_its_numbers_again_however_it_ends(
    room: PanelRoom, page: PanelPage, ends: str
) -> None:
    before = speed_of(room)
    with room.page() as other:
        other.done("teach_try_program", parameter=SPEED, values="2, 5", starts=3)
        hold(other)
        other.done("teach_set_value", value=2)
        assert speed_of(room) == 2
        if ends == "it is stopped":
            page.done("teach_stop_trying")
    until(lambda: speed_of(room) == before)
    part = page.part("tries", lambda part: part["tries"] and part["tries"]["is_over"])
    assert part["tries"]["problem"] == STOPPED
    page.done("teach_try_program", parameter=SPEED, values="2", starts=1)


def test_a_programs_mistakes_are_explained(room: PanelRoom, page: PanelPage) -> None:
    for wrong, sentence in (
        ({"values": "1, 2", "starts": 101}, "expected at most 200 episodes of a program"),
        ({"values": "1, two"}, "expected numbers with commas between"),
        ({"parameter": "0.move.speed"}, "no number of this scene is called"),
    ):
        words = {"parameter": SPEED, "values": "1", "starts": 1} | wrong
        assert sentence in page.failed("teach_try_program", **words)["text"]
    page.done("teach_try_program", parameter="0.vision.rows", values="9", starts=1)
    hold(page)
    text = page.failed("teach_set_value", value=9)["text"]
    assert "can't be 9 while a program drives" in text
    assert speed_of(room) > 0
