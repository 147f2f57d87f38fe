"""Python code that drives an agent from a notebook, shown in the agent's tab."""

from viser import GuiMarkdownHandle

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.script_lines import script_lines
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer.viewer_client import ViewerClient

DEFAULT_ADDRESS = "http://127.0.0.1:8080"
"""Address in the code if the page's own address is unknown."""


class RemoteLines:
    """A folder with the code for the agent that a page shows.

    Args:
        viewer_client: the page.
        runner: the runner of the agent's world.
    """

    def __init__(self, viewer_client: ViewerClient, runner: Runner) -> None:
        self._viewer_client, self._runner = viewer_client, runner
        self._agent: BasicAgent | None = None
        gui = viewer_client.client.gui
        with gui.add_folder("Drive it from Python", expand_by_default=False):
            self.lines: GuiMarkdownHandle = gui.add_markdown("")

    def draw(self) -> None:
        """Write the code again, if the page shows another agent."""
        wanted = self._viewer_client.agent
        agent = next((each for each in self._runner.sim.agents if each.id == wanted), None)
        if agent is not None and agent is not self._agent:
            self._agent = agent
            self.lines.content = lines(self._viewer_client.address or DEFAULT_ADDRESS, agent)


def lines(address: str, agent: BasicAgent) -> str:
    """Return the code, with instructions, as markdown."""
    return (
        "Paste this into a notebook on any machine that has `ai4u-edu`:\n\n"
        f"```python\n{script_lines(address, agent)}```\n"
    )
