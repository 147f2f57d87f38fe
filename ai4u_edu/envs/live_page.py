"""Page of an environment: shows the world while a learner steps it."""

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Percept
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import open_on_desktop


class LivePage:
    """Server of a world that an environment steps, at the pace of the wall clock.

    Requests from the page (pause, speed, reset) are carried out between steps.

    Args:
        sim: the world and its agents.
        title: the page's title.
    """

    def __init__(self, sim: ControlRequestor, title: str) -> None:
        self._runner = Runner(sim)
        self._served = serve_world(self._runner, title=title)
        self.url = self._served.url
        """Where the page is."""
        open_on_desktop(self.url)

    def step(self, agent: BasicAgent) -> Percept:
        """Run the world in real time until an agent's decision is over."""
        runner, before = self._runner, agent.steps
        while not agent.done and agent.steps == before:
            runner.advance()
            if runner.error:
                raise AI4UError(runner.error)
        return agent.percept

    def close(self) -> None:
        """Stop serving the page."""
        self._served.stop()
        self._runner.stop()
