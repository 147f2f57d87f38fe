"""What each agent senses, does and gets, in a panel of its own."""

from html import escape

from viser import GuiApi

from ai4u_edu.snapshot import AgentState, Snapshot, Stage
from ai4u_edu.viewer.local_server import LocalServer
from ai4u_edu.viewer.readings import action, block, readings, rewards


class AgentPanel:
    """A folder for each agent; what changed is sent."""

    def __init__(self, server: LocalServer) -> None:
        self._gui = server.gui
        panel = self._gui.add_panel()
        self._tab = panel.add_tab("Agents")
        panel.dock_below(self._gui.main_panel)
        self._folders: dict[str, _Folder] = {}

    def build(self, stage: Stage) -> None:
        """Makes a folder for each agent, if there are other agents than before."""
        ids = list(stage.agent_of.values())
        if ids == list(self._folders):
            return
        for folder in self._folders.values():
            folder.remove()
        with self._tab:
            self._folders = {
                agent_id: _Folder(self._gui, agent_id, body, expanded=len(ids) <= 2)
                for body, agent_id in stage.agent_of.items()
            }

    def draw(self, snapshot: Snapshot) -> None:
        """Shows the agents' last decisions."""
        for agent in snapshot.agents:
            folder = self._folders.get(agent.id)
            if folder is not None:
                folder.show(agent)


class _Folder:
    def __init__(self, gui: GuiApi, agent_id: str, body: str, *, expanded: bool) -> None:
        self._folder = gui.add_folder(f"Agent {agent_id}: {body}", expand_by_default=expanded)
        with self._folder:
            self._state = gui.add_html("")
            self._senses = gui.add_html("")
            self._action = gui.add_html("")
            self._reward = gui.add_html("")

    def show(self, agent: AgentState) -> None:
        self._state.content = state(agent)
        self._senses.content = readings(agent.percept)
        self._action.content = action(agent.action)
        self._reward.content = rewards(agent.reward_terms, agent.episode_terms)

    def remove(self) -> None:
        self._folder.remove()


def state(agent: AgentState) -> str:
    """Who decides for an agent, and how far it is, as HTML."""
    words = [f"<small>Brain</small> {escape(agent.brain)}"]
    if agent.terminated:
        words.append("<b>episode over</b>")
    elif agent.truncated:
        words.append("<b>cut off at the step limit</b>")
    elif agent.paused:
        words.append("<b>paused</b>")
    if agent.clipped:
        words.append(f"{agent.clipped} numbers out of range, cut")
    return block("<br>".join(words))
