"""A network that is watched, and races against it, as a page asks for them."""

from collections.abc import Iterator

import pytest

from ai4u_edu.agent.driving_keys import has_driving_keys
from tests.page.panel.rooms import PanelPage, PanelRoom, panel_room
from tests.page.server.rooms import Page
from tests.waiting import LIMIT_S, until

ZOO = "network:zoo:box_chase"


@pytest.fixture
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as page:
        page.show("0")
        page.part("watch", agent="0")
        yield page


def test_a_network_is_watched_and_gives_the_robot_back(room: PanelRoom, page: PanelPage) -> None:
    agent, before = room.runner.sim.agents[0], room.editor.state
    assert page.part("watch")["networks"] == [{"name": ZOO, "title": "Trained network"}]
    seed, own = room.runner.latest.seed, agent.brain
    page.done("watch_network")
    page.part("watch", watching=ZOO)
    assert not has_driving_keys(agent)
    assert not room.runner.paused
    assert room.runner.latest.seed == seed
    # a drive of a second is shown in slow motion, and says why without any tab
    assert room.runner.time_scale < 0.5
    assert page.part("why", problem="")["sentence"].startswith(("It ", "No single"))
    page.done("stop_watching")
    page.part("watch", watching="")
    assert agent.brain is own
    assert agent.brains == [own]
    assert room.runner.time_scale == 1
    assert room.runner.latest.seed == seed
    # nothing of the scene has changed, and there is nothing to undo
    assert room.editor.state == before
    assert room.editor.undo_label == ""


def test_a_driving_key_ends_it_where_the_robot_is(room: PanelRoom, page: PanelPage) -> None:
    agent = room.runner.sim.agents[0]
    own = agent.brain
    page.done("watch_network")
    with Page(room.url + "ws/input") as driver:
        driver.receive("hello", others="A network")
        driver.hold("KeyW")
        driver.receive("hello", others="", instead="")
        page.part("watch", watching="")
        assert agent.brain is own
        until(lambda: agent.brains == [own])
        until(lambda: room.runner.time_scale == 1)
    # the page has gone, and the network does not come back
    assert has_driving_keys(agent)


def test_a_person_races_against_the_networks_ghost(room: PanelRoom, page: PanelPage) -> None:
    agent = room.runner.sim.agents[0]
    page.done("watch_network")
    page.done("race_network")
    race = page.part("watch", lambda part: part["race"])["race"]
    assert has_driving_keys(agent)
    assert (race["ghost"], race["is_won"]) == ("network", True)
    # keys can win: whoever sees 0.4 s late needs at least 2.5 s
    assert 0 < race["full_speed_s"] < 2
    assert 4 < race["seconds"] < 6
    assert race["seed"] == str(room.runner.latest.seed)
    (ghost,) = room.context.ghosts.drives
    assert ghost.label == "network, slowed"
    assert ghost.stretch == pytest.approx(race["seconds"] / race["full_speed_s"], rel=0.02)
    until(lambda: ghost.path)
    assert page.part("watch")["watching"] == ""
    page.done("remove_ghost")
    page.part("watch", race=None)


def test_the_network_races_against_a_persons_drive(room: PanelRoom, page: PanelPage) -> None:
    assert page.part("watch")["has_drive"] is False
    assert "drive first" in page.failed("watch_network", against_my_drive=True)["text"]
    page.done("decision")
    page.done("decision")
    driven = room.runner.latest.seed
    page.done("new_start")
    page.part("watch", has_drive=True)
    assert room.runner.latest.seed != driven
    page.done("watch_network", against_my_drive=True)
    part = page.part("watch", lambda part: part["race"], watching=ZOO)
    assert (part["race"]["ghost"], part["race"]["is_won"]) == ("drive", False)
    assert part["race"]["seed"] == str(driven) == str(room.runner.latest.seed)
    (ghost,) = room.context.ghosts.drives
    assert ghost.label == "you"


def test_another_scene_and_another_driver_end_it(room: PanelRoom, page: PanelPage) -> None:
    page.done("watch_network")
    page.done("driver", name="brain:0")
    page.part("watch", watching="")
    until(lambda: room.runner.time_scale == 1)
    page.done("watch_network")
    page.done("open_scene", name="sumo")
    page.part("watch", watching="", networks=[])
    until(lambda: room.runner.time_scale == 1)
    text = page.failed("watch_network")["text"]
    assert "no trained network for this scene" in text


def test_a_network_that_does_not_fit_is_refused(room: PanelRoom, page: PanelPage) -> None:
    agent = room.runner.sim.agents[0]
    own = agent.brain
    page.done("remove_block", path=["sensors", 0])
    text = page.failed("watch_network")["text"]
    assert "this network can't drive this robot" in text
    assert agent.brain is own
    assert room.runner.submit(lambda: agent.brains).result(LIMIT_S) == [own]
