"""The tab in which a page shows an agent: what it senses, does and gets."""

from viser import (
    ClientHandle,
    GuiButtonHandle,
    GuiDropdownHandle,
    GuiEvent,
    GuiFolderHandle,
    GuiHtmlHandle,
    Icon,
    IconName,
)

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.theme import Rgb, group_colours
from ai4u_edu.viewer.panel.agent_html import SIMPLE, AgentHtmlCache, title
from ai4u_edu.viewer.panel.plot import RewardPlot
from ai4u_edu.viewer.panel.readings import block, heading
from ai4u_edu.viewer.panel.remote_lines import RemoteLines
from ai4u_edu.viewer.panel.status import legend
from ai4u_edu.viewer.scene.sense_overlay import is_drawable, is_shown_by_default
from ai4u_edu.viewer.viewer_client import ViewerClient

SHOWN: IconName = Icon.EYE
HIDDEN: IconName = Icon.EYE_OFF


class AgentTab:
    """One page's view of the agent that it looks at.

    Args:
        viewer_client: the page.
        runner: whose agents can be driven from elsewhere.
        html_cache: the same for all pages.
    """

    def __init__(
        self, viewer_client: ViewerClient, runner: Runner, html_cache: AgentHtmlCache
    ) -> None:
        gui = viewer_client.client.gui
        self._viewer_client, self._html_cache = viewer_client, html_cache
        self._static_scene: StaticScene | None = None
        self._colours: dict[str, Rgb] = {}
        self._ids: dict[str, str] = {}
        self._everybody = gui.add_html("", visible=False)
        self.list = gui.add_dropdown("Look at", ("",), visible=False)
        self.list.on_update(self._on_choice)
        self._state, self._decision = gui.add_html(""), gui.add_html("")
        self._inside = gui.add_html("")
        self._legend = gui.add_html("")
        self._senses = _Senses(viewer_client)
        self._also, self._action, self._ledger = (gui.add_html("") for _ in range(3))
        self._plot = RewardPlot(gui)
        self._lines = RemoteLines(viewer_client, runner)

    def draw(self, snapshot: Snapshot) -> None:
        """Shows the agent's last decision."""
        if snapshot.static_scene is not self._static_scene:
            self._meet(snapshot.static_scene)
        agent = next(
            (each for each in snapshot.agents if each.id == self._viewer_client.agent), None
        )
        if agent is None:
            return
        name = next(name for name, each in self._ids.items() if each == agent.id)
        if self.list.value != name:
            self.list.value = name  # type: ignore[misc]  # a method parts getter from setter
        self._senses.meet(agent)
        html = self._html_cache.html(agent, snapshot, self._colours, self._senses.lit(agent))
        self._everybody.content = html.everybody
        self._state.content, self._decision.content = html.state, html.decision
        self._inside.content, self._also.content = html.inside, html.also
        self._action.content, self._ledger.content = html.action, html.ledger
        self._senses.show(html.senses)
        self._plot.draw(agent.history, lambda: self._html_cache.curves(agent))
        self._lines.draw()

    def _meet(self, static_scene: StaticScene) -> None:
        self._static_scene, self._colours = static_scene, group_colours(static_scene)
        self._legend.content = block(heading("Senses"), legend(static_scene))
        self._ids = {
            title(agent_id, body): agent_id for body, agent_id in static_scene.agent_of.items()
        }
        several = len(self._ids) > 1
        self._everybody.visible = self.list.visible = several
        if self.list.options != tuple(self._ids):
            self.list.options = tuple(self._ids)

    async def _on_choice(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        if event.client is not None:  # not because the list has other options now
            self._viewer_client.agent = self._ids.get(event.target.value, self._viewer_client.agent)


class _Senses:
    """A part for each sensor; one that can be shown in the scene has a button above it."""

    def __init__(self, viewer_client: ViewerClient) -> None:
        self._viewer_client = viewer_client
        self._client: ClientHandle = viewer_client.client
        self._folder: GuiFolderHandle = self._client.gui.add_folder(None)
        self._seen: tuple[str, tuple[SensorInfo, ...]] | None = None
        self._parts: dict[str, GuiHtmlHandle] = {}
        self._buttons: dict[str, GuiButtonHandle] = {}
        self._inside: list[GuiButtonHandle | GuiHtmlHandle] = []

    def meet(self, agent: AgentState) -> None:
        """Makes the parts, if it is another agent, or has other sensors."""
        if self._seen is not None and self._seen == (agent.id, agent.sensor_infos):
            return
        self._seen = (agent.id, agent.sensor_infos)
        for handle in self._inside:
            handle.remove()
        self._inside, self._parts, self._buttons = [], {}, {}
        gui = self._client.gui
        with self._folder:
            for sense in agent.sensor_infos:
                if sense.block in SIMPLE:
                    continue
                if is_drawable(sense, agent):
                    self._add_button(agent, sense)
                self._parts[sense.key] = gui.add_html("")
                self._inside.append(self._parts[sense.key])

    def lit(self, agent: AgentState) -> set[str]:
        """The keys of the sensors that are shown in the scene; their buttons say so."""
        found = {
            sense.key
            for sense in agent.sensor_infos
            if is_drawable(sense, agent)
            and self._viewer_client.lights(sense.key, by_itself=is_shown_by_default(sense, agent))
        }
        for key, button in self._buttons.items():
            icon = SHOWN if key in found else HIDDEN
            if button.icon != icon:
                button.icon = icon
        return found

    def show(self, parts: dict[str, str]) -> None:
        for key, html in parts.items():
            self._parts[key].content = html

    def _add_button(self, agent: AgentState, sense: SensorInfo) -> None:
        key, by_itself = sense.key, is_shown_by_default(sense, agent)
        hint = f"Shows in the scene what {key} is about, or hides it"
        button = self._client.gui.add_button(key, icon=HIDDEN, hint=hint)

        async def toggle(_event: object) -> None:
            self._viewer_client.light(key, not self._viewer_client.lights(key, by_itself=by_itself))

        button.on_click(toggle)
        self._buttons[key] = button
        self._inside.append(button)
