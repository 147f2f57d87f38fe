"""The "Agent" tab: readings, action and rewards of the agent that a page shows."""

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
from ai4u_edu.snapshot.agent_words import title
from ai4u_edu.snapshot.block_info import SensorInfo
from ai4u_edu.snapshot.theme import Rgb, group_colours
from ai4u_edu.viewer.panel.agent_html import ONE_VALUE_SENSORS, AgentHtmlCache
from ai4u_edu.viewer.panel.html_parts import heading, section
from ai4u_edu.viewer.panel.plot import RewardPlot
from ai4u_edu.viewer.panel.remote_lines import RemoteLines
from ai4u_edu.viewer.panel.status import legend
from ai4u_edu.viewer.panel.widgets import set_options, set_value
from ai4u_edu.viewer.scene.sense_overlay import is_drawable, is_shown_by_default
from ai4u_edu.viewer.viewer_client import ViewerClient

SHOWN: IconName = Icon.EYE
HIDDEN: IconName = Icon.EYE_OFF


class AgentTab:
    """The "Agent" tab of one page.

    Args:
        viewer_client: the page.
        runner: the runner of the world.
        html_cache: cache that all pages share.
    """

    def __init__(
        self, viewer_client: ViewerClient, runner: Runner, html_cache: AgentHtmlCache
    ) -> None:
        gui = viewer_client.client.gui
        self._viewer_client, self._html_cache = viewer_client, html_cache
        self._static_scene: StaticScene | None = None
        self._colours: dict[str, Rgb] = {}
        self._ids: dict[str, str] = {}
        self._overview = gui.add_html("", visible=False)
        self.list = gui.add_dropdown("Look at", ("",), visible=False)
        self.list.on_update(self._on_choice)
        self._state, self._decision = gui.add_html(""), gui.add_html("")
        self._needs = gui.add_html("")
        self._legend = gui.add_html("")
        self.sensors = _SensorList(viewer_client)
        self._one_value_sensors = gui.add_html("")
        self._action, self._rewards = gui.add_html(""), gui.add_html("")
        self._plot = RewardPlot(gui)
        self.remote_lines = RemoteLines(viewer_client, runner)

    @property
    def html(self) -> str:
        """All HTML of the tab, from top to bottom."""
        above = [self._legend, self._state, self._decision, self._needs]
        below = [self._one_value_sensors, self._action, self._rewards]
        parts = [*above, *self.sensors.readings.values(), *below]
        return "".join(each.content for each in parts)

    def draw(self, snapshot: Snapshot) -> None:
        """Show the agent's last decision."""
        if snapshot.static_scene is not self._static_scene:
            self._read_static_scene(snapshot.static_scene)
        agent = next(
            (each for each in snapshot.agents if each.id == self._viewer_client.agent), None
        )
        if agent is None:
            return
        name = next(name for name, each in self._ids.items() if each == agent.id)
        set_value(self.list, name)
        self.sensors.build(agent)
        shown = self.sensors.update_buttons(agent)
        html = self._html_cache.html(agent, snapshot, self._colours, shown)
        self._overview.content = html.overview
        self._state.content, self._decision.content = html.state, html.decision
        self._needs.content = html.needs
        self._one_value_sensors.content = html.one_value_sensors
        self._action.content, self._rewards.content = html.action, html.rewards
        self.sensors.show(html.sensors)
        self._plot.draw(agent.history, lambda: self._html_cache.curves(agent))
        self.remote_lines.draw()

    def _read_static_scene(self, static_scene: StaticScene) -> None:
        self._static_scene, self._colours = static_scene, group_colours(static_scene)
        self._legend.content = section(heading("Senses"), legend(static_scene))
        self._ids = {
            title(agent_id, body): agent_id for body, agent_id in static_scene.agent_of.items()
        }
        several = len(self._ids) > 1
        self._overview.visible = self.list.visible = several
        set_options(self.list, tuple(self._ids))

    async def _on_choice(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        if event.client is not None:  # None if the change comes from new options
            self._viewer_client.agent = self._ids.get(event.target.value, self._viewer_client.agent)


class _SensorList:
    """The sensors' readings; a sensor that can be drawn in the scene has a button to do so."""

    def __init__(self, viewer_client: ViewerClient) -> None:
        self._viewer_client = viewer_client
        self._client: ClientHandle = viewer_client.client
        self._folder: GuiFolderHandle = self._client.gui.add_folder(None)
        self._built_for: tuple[str, tuple[SensorInfo, ...]] | None = None
        self.readings: dict[str, GuiHtmlHandle] = {}
        self.buttons: dict[str, GuiButtonHandle] = {}
        self._handles: list[GuiButtonHandle | GuiHtmlHandle] = []

    def build(self, agent: AgentState) -> None:
        """Create the widgets, if the agent or its sensors have changed."""
        if self._built_for is not None and self._built_for == (agent.id, agent.sensor_infos):
            return
        self._built_for = (agent.id, agent.sensor_infos)
        for handle in self._handles:
            handle.remove()
        self._handles, self.readings, self.buttons = [], {}, {}
        gui = self._client.gui
        with self._folder:
            for sensor in agent.sensor_infos:
                if sensor.block in ONE_VALUE_SENSORS:
                    continue
                if is_drawable(sensor, agent):
                    self._add_button(agent, sensor)
                self.readings[sensor.key] = gui.add_html("")
                self._handles.append(self.readings[sensor.key])

    def update_buttons(self, agent: AgentState) -> set[str]:
        """Update the buttons' icons, and return the keys of the sensors drawn in the scene."""
        shown = {
            sensor.key
            for sensor in agent.sensor_infos
            if is_drawable(sensor, agent)
            and self._viewer_client.shows_sensor(
                sensor.key, is_default=is_shown_by_default(sensor, agent)
            )
        }
        for key, button in self.buttons.items():
            icon = SHOWN if key in shown else HIDDEN
            if button.icon != icon:
                button.icon = icon
        return shown

    def show(self, readings: dict[str, str]) -> None:
        for key, html in readings.items():
            self.readings[key].content = html

    def _add_button(self, agent: AgentState, sensor: SensorInfo) -> None:
        key, is_default = sensor.key, is_shown_by_default(sensor, agent)
        hint = f"Shows in the scene what {key} is about, or hides it"
        button = self._client.gui.add_button(key, icon=HIDDEN, hint=hint)

        async def toggle(_event: object) -> None:
            self._viewer_client.show_sensor(
                key, not self._viewer_client.shows_sensor(key, is_default=is_default)
            )

        button.on_click(toggle)
        self.buttons[key] = button
        self._handles.append(button)
