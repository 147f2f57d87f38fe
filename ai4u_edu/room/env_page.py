"""Page of an environment: shows the world while a learner steps it."""

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.options import LivePage
from ai4u_edu.page.server import open_on_desktop
from ai4u_edu.room.served_world import serve_world
from ai4u_edu.runtime.runner import Runner


class EnvPage(LivePage):
    """Server of a world that an environment steps, at the pace of the wall clock.

    Requests from the page (pause, speed, reset) are carried out between ticks.

    Args:
        sim: the world and its agents.
        title: the page's title.
    """

    def __init__(self, sim: ControlRequestor, title: str) -> None:
        self._runner = Runner(sim)
        self._served = serve_world(self._runner, title=title)
        self.url = self._served.url
        open_on_desktop(self.url)

    def advance(self) -> None:
        """Run one tick when it is due."""
        self._runner.advance()
        if self._runner.error:
            raise AI4UError(self._runner.error)

    def close(self) -> None:
        """Stop serving the page."""
        self._served.stop()
        self._runner.stop()
