"""What an agent senses, does and gets, in a panel: on each page the agent that is looked at."""

from urllib.parse import unquote

from viser import ClientHandle, GuiDropdownHandle, GuiEvent

from ai4u_edu.look import Rgb, group_colours
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.agent_html import AgentHtml, overview, title
from ai4u_edu.viewer.local_server import LocalServer

AGENT_HEADER = "X-AI4U-Edu-Agent"
"""By this our proxy tells viser which agent a page is about, percent-encoded."""


class AgentPanel:
    """A panel on each page, in which one agent is open at a time.

    Args:
        server: viser's.
        first: the id of the agent that a page shows which is about none in particular.
    """

    def __init__(self, server: LocalServer, first: str) -> None:
        self._server = server
        self._first = first
        self._pages: dict[int, _Page] = {}
        self._agent_of: dict[str, str] = {}
        self._colours: dict[str, Rgb] = {}

    def build(self, stage: Stage) -> None:
        """Learns the stage's colours; if there are other agents than before, makes new panels."""
        self._stage, self._colours = stage, group_colours(stage)
        if stage.agent_of == self._agent_of:
            return
        self._agent_of = dict(stage.agent_of)
        for page in self._pages.values():
            page.remove()
        self._pages = {}

    def draw(self, snapshot: Snapshot) -> None:
        """Shows the agents' last decisions to all pages, new ones too."""
        clients = self._server.get_clients()
        for gone in self._pages.keys() - clients.keys():
            del self._pages[gone]
        for new in sorted(clients.keys() - self._pages.keys()):
            self._pages[new] = _Page(clients[new], self._agent_of, self._wanted(new))
        # once for all pages that look at the same agent
        written: dict[str, tuple[AgentHtml, str]] = {}
        for page in self._pages.values():
            for agent in snapshot.agents:
                if agent.id == page.chosen:
                    if agent.id not in written:
                        html = AgentHtml.of(agent, self._colours)
                        written[agent.id] = html, overview(snapshot, agent.id)
                    page.show(*written[agent.id])

    def choose(self, client_id: int, body: str) -> None:
        """Opens the agent of that body on one page."""
        page, agent_id = self._pages.get(client_id), self._agent_of.get(body)
        if page is not None and agent_id is not None:
            page.choose(agent_id)

    def chosen(self, client_id: int) -> str:
        """The id of the agent that one page looks at."""
        page = self._pages.get(client_id)
        return self._first if page is None else page.chosen

    def watched(self) -> set[str]:
        """The ids of the agents that somebody looks at."""
        return {page.chosen for page in tuple(self._pages.values())} or {self._first}

    def _wanted(self, client_id: int) -> str:
        connection = self._server._websock_server._live_connections.get(client_id)
        request = getattr(connection, "request", None)
        asked = unquote(request.headers.get(AGENT_HEADER, "")) if request is not None else ""
        known = list(self._agent_of.values())
        return asked if asked in known else self._first if self._first in known else known[0]


class _Page:
    """The panel of one page."""

    def __init__(self, client: ClientHandle, agent_of: dict[str, str], chosen: str) -> None:
        gui = client.gui
        names = {agent_id: title(agent_id, body) for body, agent_id in agent_of.items()}
        self.chosen = chosen
        self._names = names
        self._ids = {name: agent_id for agent_id, name in names.items()}
        self._panel = gui.add_panel()
        with self._panel.add_tab("Agents" if len(names) > 1 else "Agent"):
            self._is_one_of_several = len(names) > 1
            if self._is_one_of_several:
                self._overview = gui.add_html("")
                self._list = gui.add_dropdown(
                    "Look at", tuple(self._ids), initial_value=names[chosen]
                )
                self._list.on_update(self._on_choice)
            self._parts = [gui.add_html("") for _ in AgentHtml._fields]
        self._panel.dock_below(gui.main_panel)

    def choose(self, agent_id: str) -> None:
        self.chosen = agent_id
        if self._is_one_of_several:
            # a method parts its getter from its setter
            self._list.value = self._names[agent_id]  # type: ignore[misc]

    def show(self, html: AgentHtml, everybody: str) -> None:
        if self._is_one_of_several:
            self._overview.content = everybody
        for handle, content in zip(self._parts, html, strict=True):
            handle.content = content

    def remove(self) -> None:
        self._panel.remove()

    async def _on_choice(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        self.chosen = self._ids.get(event.target.value, self.chosen)
