import re

from ai4u_edu import Scene
from ai4u_edu.snapshot import Need, capture_snapshot
from ai4u_edu.viewer.panel.agent_html import AgentHtml
from ai4u_edu.viewer.panel.needs import needs

ENERGY = Need("energy", 60.0, (0.0, 200.0), (50.0, 150.0))


def widths(html: str) -> list[float]:
    return [float(each) for each in re.findall(r"(?:left|width):([\d.]+)%", html)]


def test_a_bar_shows_the_level_and_the_zone_as_shares_of_the_range() -> None:
    assert widths(needs([ENERGY])) == [25.0, 50.0, 30.0]
    below_zero = Need("warmth", 0.0, (-1.0, 1.0), (-0.5, 0.0))
    assert widths(needs([below_zero])) == [25.0, 25.0, 50.0]


def test_outside_of_its_zone_a_level_says_so_in_words() -> None:
    assert "low" not in needs([ENERGY])
    assert "49 low" in needs([ENERGY._replace(level=49.0)])
    assert "151 high" in needs([ENERGY._replace(level=151.0)])


def test_names_are_escaped_and_no_variables_are_nothing() -> None:
    assert "&lt;i&gt;" in needs([ENERGY._replace(name="<i>")])
    assert needs([]) == ""


def test_what_an_agent_needs_stands_in_its_panel() -> None:
    sim = Scene.load("forage").build()
    sim.reset(1)
    sim.step()
    (agent,) = capture_snapshot(sim).agents
    assert [need.name for need in agent.needs] == ["energy", "water"]
    assert agent.needs[0].level < 60
    assert agent.needs[0].comfort == (40.0, 80.0)
    snapshot = capture_snapshot(sim)
    assert "energy" in AgentHtml.of(agent, snapshot, {}).needs
    assert not AgentHtml.of(agent._replace(needs=()), snapshot, {}).needs
