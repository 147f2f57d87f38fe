"""Time control through the panel's socket."""

from collections.abc import Iterator

import pytest

from ai4u_edu.snapshot.agent_words import ending
from tests.page.panel.rooms import PanelPage, PanelRoom, panel_room
from tests.waiting import LIMIT_S


@pytest.fixture(scope="module")
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    room.runner.pause().result(LIMIT_S)
    with room.page() as page:
        yield page


def test_a_page_is_told_the_state_of_the_world(page: PanelPage) -> None:
    run = page.part("run")
    assert run["is_paused"]
    assert run["status"] == "Paused"
    scene = page.part("scene")
    assert scene["title"] == "Box chase"
    assert scene["agents"][0]["body"] == "robot"
    assert scene["agents"][0]["is_person"]
    assert scene["can_edit"]


def test_the_world_is_paused_and_resumed(page: PanelPage) -> None:
    page.done("resume")
    assert page.part("run", is_paused=False)["status"].startswith("Running")
    page.done("pause")
    page.part("run", is_paused=True)


def test_single_ticks_and_decisions(page: PanelPage, room: PanelRoom) -> None:
    page.done("new_start")
    before = room.runner.latest.tick
    page.done("tick")
    assert room.runner.latest.tick == before + 1
    page.done("decision")
    assert page.part("run", decision=1)["is_paused"]


def test_the_same_start_and_a_new_one(page: PanelPage, room: PanelRoom) -> None:
    seed = "9223372036854775807"
    page.done("seed", seed=seed)
    assert page.part("run", seed=seed)["seed"] == seed
    begin = room.runner.latest.bodies
    for _ in range(20):
        page.done("tick")
    page.done("try_again")
    assert room.runner.latest.bodies == begin
    page.done("new_start")
    assert room.runner.latest.bodies != begin


def test_the_speed(page: PanelPage) -> None:
    page.done("speed", speed="max")
    page.part("run", speed="max")
    page.done("speed", speed=0.25)
    page.part("run", speed=0.25)
    assert page.failed("speed", speed=0)["text"] == "speed: expected float > 0.0"


def test_a_seed_that_is_too_large(page: PanelPage) -> None:
    assert "expected a whole number" in page.failed("seed", seed="9" * 30)["text"]


def test_two_pages_see_the_same_moments(page: PanelPage, room: PanelRoom) -> None:
    with room.page() as other:
        page.done("resume")
        for each in (page, other):  # so that neither takes a moment before for the one after
            each.part("run", is_paused=False)
        page.done("pause")
        assert (
            other.part("run", is_paused=True)["time_s"]
            == page.part("run", is_paused=True)["time_s"]
        )


def test_the_seed_is_repeated_drawn_and_locked(page: PanelPage, room: PanelRoom) -> None:
    seeds = [room.runner.latest.seed]
    for command in ("new_start", "try_again"):
        page.done(command)
        seeds.append(room.runner.latest.seed)
    assert seeds[0] != seeds[1] == seeds[2]
    for is_on in (True, False):
        page.done("lock_seed", on=is_on)
        page.part("run", is_seed_locked=is_on)
        room.runner.reset().result(LIMIT_S)
        assert (room.runner.latest.seed == seeds[1]) == is_on


def test_the_end_by_the_step_limit_is_told_as_the_banner_tells_it(room: PanelRoom) -> None:
    agent = room.runner.latest.agents[0]
    assert ending(agent._replace(terminated=False, truncated=True)) == "time is up"
