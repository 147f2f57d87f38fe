"""An option outside the package: a command, a tab with its part, and a part of the picture."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec

from ai4u_edu.base.options import OptionTab
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.messages import Name, PageCommand
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, StaticScene

KEY = "greeting"
made: "list[Greeting]" = []
"""Options that were made, the latest last."""


class Greet(PageCommand, tag="greet"):
    """Greet somebody."""

    who: Name


class GreetingLabel:
    """A label over the world, with what a page has said last."""

    def __init__(self, pages: ViewerClients) -> None:
        self._pages = pages
        self.texts: list[str] = []

    def build(self, static_scene: StaticScene) -> None:
        """Do nothing; the label does not depend on the scene."""

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the label on each page that has greeted somebody."""
        for page in self._pages.values():
            if KEY in page.choices:
                self.texts.append(f"{page.choices[KEY]} at {snapshot.tick}")
                page.client.scene.add_label("/greeting", str(page.choices[KEY]))


class Greeting:
    """The option, of one world."""

    agent_parts = frozenset({KEY})
    tab = OptionTab(KEY, "Greeting", Path(__file__).with_suffix(".js"))

    def __init__(self, runner: Runner, player: ReplayPlayer) -> None:
        self.commands: Mapping[type[PageCommand], Handler] = {Greet: self._greet}
        self.label: GreetingLabel | None = None
        self.is_stopped = False

    async def _greet(self, page: Page, command: Greet) -> Answer:
        page.view.choose(KEY, f"Hello {command.who}", KEY)
        return Answer(f"Hello {command.who}.")

    def panel_parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield what the page has said."""
        if KEY in view.choices:
            part = {"type": "part", "name": KEY, "text": view.choices[KEY]}
            yield KEY, msgspec.json.encode(part)

    def picture_parts(self, pages: ViewerClients) -> list[tuple[Part, float]]:
        """Return the label."""
        self.label = GreetingLabel(pages)
        return [(self.label, 60.0)]

    def ray_weights(self, page: ViewerClient) -> None:
        """Leave the rays as they are."""

    def stop(self) -> None:
        """Note the end."""
        self.is_stopped = True


def page_option(runner: Runner, player: ReplayPlayer, _editor: SceneEditor | None) -> Greeting:
    """Return the option for a world."""
    made.append(Greeting(runner, player))
    return made[-1]
