from dataclasses import replace

from ai4u_edu.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.agent_panel import AgentPanel, state


def panel_of(viewer: Viewer) -> AgentPanel:
    (panel,) = (each._part for each in viewer._parts if isinstance(each._part, AgentPanel))
    return panel


def test_each_agent_has_its_senses_action_and_reward(viewer: Viewer) -> None:
    folder = panel_of(viewer)._folders["0"]
    assert "fan" in folder._senses.content
    assert "Action" in folder._action.content
    assert "Reward" in folder._reward.content
    assert "LocalBrain" in folder._state.content


def test_other_agents_get_other_folders(viewer: Viewer, runner: Runner) -> None:
    panel = panel_of(viewer)
    before = panel._folders["0"]
    panel.build(runner.latest.stage)
    assert panel._folders["0"] is before
    panel.build(replace(runner.latest.stage, agent_of={"robot": "7"}))
    assert list(panel._folders) == ["7"]
    assert before._folder._impl.removed
    panel.draw(runner.latest)  # a picture of the old agent is no error


def test_the_state_of_an_agent(runner: Runner) -> None:
    agent = replace(runner.latest.agents[0], brain="<script>")
    assert "&lt;script&gt;" in state(agent)
    assert "over" in state(replace(agent, terminated=True))
    assert "cut off" in state(replace(agent, truncated=True))
    assert "paused" in state(replace(agent, paused=True))
    assert "3 numbers" in state(replace(agent, clipped=3))
