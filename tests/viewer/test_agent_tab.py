"""The "Agent" tab of each page."""

from collections.abc import Iterator
from dataclasses import replace

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.agent_words import title
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.agent_html import overview, state
from ai4u_edu.viewer.panel.agent_tab import HIDDEN, SHOWN, AgentTab
from tests.viewer.pages import page, shown, tabs_of, until


@pytest.fixture
def crowd() -> Runner:
    """Six agents."""
    world = World()
    names = ["one", "two", "three", "four", "five", "six men"]
    for number, name in enumerate(names):
        world.add_body(name, CircleShape(radius=0.4), position=(2 * number, 0))
    agents = [
        BasicAgent(body=name, id=name, brains=[LocalBrain(controller=lambda _percept: {})])
        for name in names
    ]
    return Runner(ControlRequestor(world, agents), seed=1)


@pytest.fixture
def crowded(crowd: Runner) -> Iterator[Viewer]:
    viewer = Viewer(crowd)
    yield viewer
    viewer.stop()


def text_of(viewer: Viewer) -> str:
    """All HTML in the tab of the only page."""
    (tab,) = tabs_of(viewer, AgentTab)
    return tab.html


def test_an_agent_has_its_senses_action_and_reward(viewer: Viewer) -> None:
    with page(viewer):
        shown(viewer)
        text = text_of(viewer)
        (tab,) = tabs_of(viewer, AgentTab)
    for expected in (
        "Agent 0: robot",
        "LocalBrain",
        "LinearRayCasting",
        "Senses",
        "Action",
        "Reward",
        "done",
    ):
        assert expected in text
    assert list(tab.sensors.buttons) == ["fan"]


def test_a_page_that_is_gone_has_no_tabs(viewer: Viewer) -> None:
    with page(viewer):
        shown(viewer)
        assert len(tabs_of(viewer, AgentTab)) == 1
    until(lambda: not viewer.server.get_clients())
    shown(viewer)
    assert tabs_of(viewer, AgentTab) == []


def test_only_what_changed_is_sent(viewer: Viewer, runner: Runner) -> None:
    with page(viewer):
        shown(viewer)
        (client,) = viewer.server.get_clients().values()
        buffer = client._websock_connection.get_message_buffer()
        before = buffer.message_counter
        shown(viewer)
        assert buffer.message_counter == before
        (tab,) = tabs_of(viewer, AgentTab)
        tab.draw(replace(runner.latest, agents=(runner.latest.agents[0]._replace(clipped=3),)))
        assert buffer.message_counter == before + 1


@pytest.mark.parametrize(
    ("asked", "opened"),
    [("", "one"), ("three", "three"), ("six%20men", "six men"), ("x", "one")],
)
def test_a_page_opens_with_its_own_agent(crowded: Viewer, asked: str, opened: str) -> None:
    with page(crowded, asked):
        shown(crowded)
        assert [each.agent for each in crowded.viewer_clients.values()] == [opened]
        assert f"<p>{opened}</p>" in text_of(crowded)


def test_another_agent_is_chosen_from_the_list(crowded: Viewer) -> None:
    with page(crowded) as here, page(crowded, "five"):
        until(lambda: len(crowded.server.get_clients()) == 2)
        shown(crowded)
        first, second = crowded.viewer_clients.values()
        tab = tabs_of(crowded, AgentTab)[0]
        here.change(tab.list, "four")
        until(lambda: first.agent == "four")
        assert second.agent == "five"
        chosen: list[str] = []
        tab.list.on_update(lambda event: chosen.append(event.target.value))
        here.change(tab.list, "nobody")
        here.change(tab.list, "three")
        until(lambda: first.agent == "three")
        until(lambda: chosen)
        assert chosen == ["three"]


def test_another_agent_is_chosen_by_a_click_on_it(crowded: Viewer) -> None:
    with page(crowded) as here:
        shown(crowded)
        (viewer_client,) = crowded.viewer_clients.values()
        here.click("/bodies1/2/body", 0)
        until(lambda: viewer_client.agent == "three")
        for nothing in (None, 17):
            here.click("/bodies1/0/body", nothing)
        here.click("/bodies1/3/body", 0)
        until(lambda: viewer_client.agent == "four")
        shown(crowded)
        (tab,) = tabs_of(crowded, AgentTab)
        assert tab.list.value == "four"


def test_other_agents_are_looked_at_as_soon_as_they_are_there(
    viewer: Viewer, runner: Runner
) -> None:
    with page(viewer):
        shown(viewer)
        (viewer_client,) = viewer.viewer_clients.values()
        (tab,) = tabs_of(viewer, AgentTab)
        static_scene = replace(runner.latest.static_scene, agent_of={"robot": "7"})
        viewer.draw(
            replace(runner.latest, static_scene=static_scene)
        )  # the agents of before are no error
        assert viewer_client.agent == "7"
        assert tab.list.options == ("Agent 7: robot",)


def test_a_sensor_is_shown_and_hidden_by_its_button(viewer: Viewer, runner: Runner) -> None:
    with page(viewer) as here:
        shown(viewer)
        (tab,) = tabs_of(viewer, AgentTab)
        (viewer_client,) = viewer.viewer_clients.values()
        button = tab.sensors.buttons["fan"]
        assert button.icon == SHOWN
        here.press(button)
        until(lambda: not viewer_client.shows_sensor("fan", is_default=True))
        shown(viewer)
        assert button.icon == HIDDEN
        here.press(button)
        until(lambda: viewer_client.shows_sensor("fan", is_default=True))


def test_each_agent_has_a_row_of_its_own(crowd: Runner) -> None:
    first, second, *others = crowd.latest.agents
    agents = (
        first._replace(steps=7, episode_reward=-2.5, terminated=True, fell=True),
        second._replace(truncated=True, succeeded=True),
        *others,
    )
    html = overview(replace(crowd.latest, agents=agents), chosen="two")
    assert "one</th><td>7</td><td>-2.50</td><td><small>fell</small>" in html
    assert "<b>two</b></th><td>0</td><td>0.00</td><td><small>reached the goal</small>" in html
    assert "episode" not in html
    ahead = (first._replace(episode=3), second, *others)
    assert "one</th><td>3</td><td>0</td>" in overview(replace(crowd.latest, agents=ahead), "two")


def test_the_state_of_an_agent(runner: Runner) -> None:
    agent = runner.latest.agents[0]._replace(brain="<script>")
    assert "&lt;script&gt;" in state(agent)
    assert "over" in state(agent._replace(terminated=True))
    assert "fell" in state(agent._replace(terminated=True, fell=True))
    assert "reached" in state(agent._replace(terminated=True, fell=True, succeeded=True))
    assert "cut off" in state(agent._replace(truncated=True))
    assert "paused" in state(agent._replace(paused=True))
    assert "3 numbers" in state(agent._replace(clipped=3))


def test_an_agent_that_is_called_as_its_body_is_named_once() -> None:
    assert title("0", "robot") == "Agent 0: robot"
    assert title("blue_keeper", "blue keeper") == "blue keeper"
