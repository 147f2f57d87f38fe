"""Practice for rewards over the panel's socket, and the network that drives meanwhile."""

from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from ai4u_edu.blocks import NeuralNetController
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.teach import learning, networks
from tests.page.panel.rooms import PanelPage, PanelRoom
from tests.teach.driving import teaching_room
from tests.waiting import until

pytestmark = pytest.mark.slow

SOON = 256
"""Decisions of the shortest practice."""
LATE = 1_000_000


@pytest.fixture
def room(tmp_path: Path) -> Iterator[PanelRoom]:
    with teaching_room(tmp_path) as served:
        yield served


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as opened:
        opened.part("teach", lambda part: part["rewards"])
        yield opened


def controller(room: PanelRoom) -> NeuralNetController | None:
    """Return the network's controller that drives; None if something else does."""
    found = getattr(room.runner.sim.agents[0].brain, "controller", None)
    return found if isinstance(found, NeuralNetController) else None


def test_a_network_practises_and_drives_then(room: PanelRoom, page: PanelPage) -> None:
    assert page.parts["teach"]["rewards"] == ["touch", "fall", "min_dist"]
    page.done("teach_practise", steps=SOON, weights={"touch": 1, "fall": 2})
    part = page.part("teach", lambda part: part["networks"] and part["networks"][0]["is_driving"])
    assert part["practice"]["is_over"]
    assert part["practice"]["problem"] == ""
    assert part["practice"]["decisions"] >= SOON
    assert len(part["practice"]["rewards"]) == 1
    assert "practised for" in part["networks"][0]["how"]
    assert room.editor.driver_of("0").startswith(NETWORK)
    page.done("teach_practise", steps=SOON, weights={}, begin_with=1)
    page.part("teach", lambda part: len(part["networks"]) == 2)


def test_the_network_of_the_moment_drives_until_it_is_stopped(
    room: PanelRoom, page: PanelPage
) -> None:
    page.done("teach_practise", steps=LATE, weights={})
    until(lambda: controller(room) is not None)
    driving = controller(room)
    assert driving is not None
    first = driving.network
    until(lambda: driving.network is not first)  # it drives with what it has learned since
    assert "learns already" in page.failed("teach_practise", steps=SOON, weights={})["text"]
    page.done("teach_stop_practising")
    part = page.part("teach", lambda part: part["practice"] and part["practice"]["is_over"])
    assert part["practice"]["problem"] == learning.STOPPED
    assert room.editor.undo_label in ("", "0: driven by network:box_chase-1.onnx")


def test_a_killed_practice_keeps_what_the_world_has(room: PanelRoom, page: PanelPage) -> None:
    page.done("teach_practise", steps=LATE, weights={})
    until(lambda: controller(room) is not None)
    (process,) = (
        each
        for each in psutil.Process().children()
        if "ai4u_edu.teach.practice_process" in each.cmdline()
    )
    process.kill()
    part = page.part("teach", lambda part: part["practice"] and part["practice"]["is_over"])
    assert part["practice"]["problem"] == learning.DIED
    room.runner.step_decision("0").result()
    assert not room.runner.error


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
        answer = page.failed("teach_practise", steps=SOON, weights={}, against="file")
        assert "expected the network to play against" in answer["text"]
        page.done("teach_practise", steps=SOON, weights={}, against="file", opponent=2)
        part = page.part("teach", lambda part: len(part["networks"]) == 3)
        assert "against Network 2" in part["networks"][0]["how"]


def test_whoever_has_taken_over_goes_on_driving(room: PanelRoom, page: PanelPage) -> None:
    page.done("teach_practise", steps=4 * SOON, weights={})
    until(lambda: controller(room) is not None)
    room.editor.set_driver("0", "brain:0").result()
    page.part("teach", lambda part: part["networks"])
    assert room.editor.driver_of("0") == "brain:0"


def test_a_network_that_can_not_be_kept_is_spoken_of(
    room: PanelRoom, page: PanelPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(networks, "MAX_NETWORKS", 0)
    page.done("teach_practise", steps=SOON, weights={})
    part = page.part("teach", lambda part: part["warning"])
    assert "The network could not be kept: expected at most 0 networks" in part["warning"]
