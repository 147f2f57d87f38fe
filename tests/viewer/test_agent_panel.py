"""Each page has its panel, in which one agent is open."""

from collections.abc import Iterator
from dataclasses import replace

import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
from ai4u_edu.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.agent_html import overview, state, title
from ai4u_edu.viewer.agent_panel import AgentPanel
from tests.viewer.pages import page, until


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
def shown(crowd: Runner) -> Iterator[Viewer]:
    viewer = Viewer(crowd)
    yield viewer
    viewer.stop()


def panel_of(viewer: Viewer) -> AgentPanel:
    (panel,) = (each._part for each in viewer._parts if isinstance(each._part, AgentPanel))
    return panel


def text_of(panel: AgentPanel) -> str:
    (opened,) = panel._pages.values()
    return "".join(handle.content for handle in opened._parts)


def test_an_agent_has_its_senses_action_and_reward(viewer: Viewer, runner: Runner) -> None:
    panel = panel_of(viewer)
    with page(viewer):
        panel.draw(runner.latest)
        text = text_of(panel)
    for expected in ("Agent 0: robot", "LocalBrain", "fan", "Action", "Reward"):
        assert expected in text


def test_a_page_that_is_gone_has_no_panel(viewer: Viewer, runner: Runner) -> None:
    panel = panel_of(viewer)
    with page(viewer):
        panel.draw(runner.latest)
        assert len(panel._pages) == 1
    until(lambda: not viewer.server.get_clients())
    panel.draw(runner.latest)
    assert panel._pages == {}


def test_only_what_changed_is_sent(viewer: Viewer, runner: Runner) -> None:
    panel = panel_of(viewer)
    with page(viewer):
        panel.draw(runner.latest)
        (client,) = viewer.server.get_clients().values()
        buffer = client._websock_connection.get_message_buffer()
        before = buffer.message_counter
        panel.draw(runner.latest)
        assert buffer.message_counter == before
        panel.draw(replace(runner.latest, agents=(replace(runner.latest.agents[0], clipped=3),)))
        assert buffer.message_counter == before + 1


@pytest.mark.parametrize(
    ("asked", "opened"),
    [("", "one"), ("three", "three"), ("six%20men", "six men"), ("x", "one")],
)
def test_a_page_opens_with_its_own_agent(
    shown: Viewer, crowd: Runner, asked: str, opened: str
) -> None:
    panel = panel_of(shown)
    with page(shown, asked):
        panel.draw(crowd.latest)
        assert [each.chosen for each in panel._pages.values()] == [opened]
        assert panel.watched() == {opened}
        assert f"<p>{opened}</p>" in text_of(panel)


def test_another_agent_is_chosen_from_the_list(shown: Viewer, crowd: Runner) -> None:
    panel = panel_of(shown)
    with page(shown) as here, page(shown, "five"):
        until(lambda: len(shown.server.get_clients()) == 2)
        panel.draw(crowd.latest)
        first, second = (panel._pages[each] for each in sorted(panel._pages))
        here.change(first._list, "four")
        until(lambda: first.chosen == "four")
        assert second.chosen == "five"
        here.change(first._list, "nobody")
        until(lambda: first._list.value == "nobody")
        assert first.chosen == "four"
        assert panel.watched() == {"four", "five"}


def test_another_agent_is_chosen_by_a_click_on_it(shown: Viewer, crowd: Runner) -> None:
    panel = panel_of(shown)
    with page(shown) as here:
        panel.draw(crowd.latest)
        (opened,) = panel._pages.values()
        here.click("/bodies1/0/body", 2)
        until(lambda: opened.chosen == "three")
        assert opened._list.value == "three"
        for nothing in (None, 17):
            here.click("/bodies1/0/body", nothing)
        here.click("/bodies1/0/body", 3)
        until(lambda: opened.chosen == "four")


def test_other_agents_get_another_panel(viewer: Viewer, runner: Runner) -> None:
    panel = panel_of(viewer)
    with page(viewer):
        panel.draw(runner.latest)
        before = next(iter(panel._pages.values()))
        panel.build(runner.latest.stage)
        assert list(panel._pages.values()) == [before]
        panel.build(replace(runner.latest.stage, agent_of={"robot": "7"}))
        panel.draw(runner.latest)  # a picture of the old agent is no error
        (after,) = panel._pages.values()
        assert (after.chosen, before._panel._impl.removed) == ("7", True)


def test_each_agent_has_a_row_of_its_own(crowd: Runner) -> None:
    first, second, *others = crowd.latest.agents
    agents = (
        replace(first, steps=7, episode_reward=-2.5, terminated=True, fell=True),
        replace(second, truncated=True, succeeded=True),
        *others,
    )
    html = overview(replace(crowd.latest, agents=agents), chosen="two")
    assert "one</th><td>7</td><td>-2.50</td><td><small>fell</small>" in html
    assert "<b>two</b></th><td>0</td><td>0.00</td><td><small>reached the goal</small>" in html
    assert "episode" not in html
    ahead = (replace(first, episode=3), second, *others)
    assert "one</th><td>3</td><td>0</td>" in overview(replace(crowd.latest, agents=ahead), "two")


def test_the_state_of_an_agent(runner: Runner) -> None:
    agent = replace(runner.latest.agents[0], brain="<script>")
    assert "&lt;script&gt;" in state(agent)
    assert "over" in state(replace(agent, terminated=True))
    assert "fell" in state(replace(agent, terminated=True, fell=True))
    assert "reached" in state(replace(agent, terminated=True, fell=True, succeeded=True))
    assert "cut off" in state(replace(agent, truncated=True))
    assert "paused" in state(replace(agent, paused=True))
    assert "3 numbers" in state(replace(agent, clipped=3))


def test_an_agent_that_is_called_as_its_body_is_named_once() -> None:
    assert title("0", "robot") == "Agent 0: robot"
    assert title("blue_keeper", "blue keeper") == "blue keeper"
