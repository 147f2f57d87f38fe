"""The lines that drive an agent from a notebook, in the panel, ready to be copied."""

from keyword import iskeyword
from typing import Any

from viser import ClientHandle, GuiDropdownHandle, GuiEvent, GuiMarkdownHandle

from ai4u_edu.agent import BasicAgent
from ai4u_edu.runner import Runner
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.local_server import LocalServer

PAGE_HEADER = "X-AI4U-Edu-Page"
"""By this our proxy tells viser the address under which a browser has the page."""


class RemoteLines:
    """A folder in each page's panel; its lines have the address by which that page was reached.

    Args:
        server: viser's.
        runner: whose agents can be driven.
    """

    def __init__(self, server: LocalServer, runner: Runner) -> None:
        self._server = server
        self._runner = runner
        self._pages: dict[int, _Folder] = {}

    def build(self, stage: Stage) -> None:
        """Nothing: agents stay when a stage is built anew."""

    def draw(self, _snapshot: Snapshot) -> None:
        """Gives pages that have come their folder."""
        clients = self._server.get_clients()
        for gone in self._pages.keys() - clients.keys():
            del self._pages[gone]
        for new in sorted(clients.keys() - self._pages.keys()):
            agents = self._runner.sim.agents
            self._pages[new] = _Folder(clients[new], agents, self._address(new))

    def _address(self, client_id: int) -> str:
        connection = self._server._websock_server._live_connections.get(client_id)
        request = getattr(connection, "request", None)
        return str(request.headers.get(PAGE_HEADER, "")) if request is not None else ""


class _Folder:
    def __init__(self, client: ClientHandle, agents: tuple[BasicAgent, ...], address: str) -> None:
        self._agents = {agent.id: agent for agent in agents}
        self._address = address or "http://127.0.0.1:8080"
        first = agents[0]
        with client.gui.add_folder("Drive it from Python", expand_by_default=False):
            if len(agents) > 1:
                self.agent = client.gui.add_dropdown("Agent", tuple(self._agents))
                self.agent.on_update(self._on_choice)
            self.lines: GuiMarkdownHandle = client.gui.add_markdown(lines(self._address, first))

    async def _on_choice(self, event: GuiEvent[GuiDropdownHandle[Any]]) -> None:
        agent = self._agents.get(str(event.target.value))
        if agent is not None:
            self.lines.content = lines(self._address, agent)


def lines(address: str, agent: BasicAgent) -> str:
    """What is to be pasted into a notebook, as markdown.

    Names stand in it as Python writes them, so that none can end the line, or the code.
    """
    example = {
        name: [1] + [0] * (len(actuator.limits()[0]) - 1)
        for name, actuator in agent.fitting.actuators.items()
        if actuator.is_output
    }
    if all(name.isidentifier() and not iskeyword(name) for name in example):
        numbers = ", ".join(f"{name}={values}" for name, values in example.items())
    else:
        numbers = repr(example)
    return (
        "Paste this into a notebook on any machine that has `ai4u-edu`:\n\n"
        "```python\n"
        "from ai4u_edu.remote import connect\n\n"
        f"robot = connect({address!r}, agent={agent.id!r})\n"
        "for percept in robot:\n"
        f"    robot.act({numbers})\n"
        "robot.close()\n"
        "```\n"
    )
