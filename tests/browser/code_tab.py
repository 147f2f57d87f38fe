"""The tab "Code" alone, with a fake Python and a fake world."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Self

from playwright.sync_api import Browser, Locator

from tests.browser.code_editor import WithEditor
from tests.browser.fake_panel import PARTS
from tests.browser.tab_page import TabPage

PROGRAM = 'def decide(percept):\n    near = percept["box"][0]\n    return {"move": [near, 0]}\n'


class CodePage(WithEditor, TabPage):
    """A page with the tab, with an agent of the fake panel."""

    def __init__(self, chromium: Browser, **options: Any) -> None:
        super().__init__(chromium, "code/tab", "CodeTab", "agent", has_fakes=True, **options)
        self.give(PARTS["scene"], "scene")
        self.give(PARTS["python"], "python")
        self.give(PARTS["agent"])

    @classmethod
    @contextmanager
    def opened(cls, chromium: Browser, **options: Any) -> Iterator[Self]:
        """Open such a page; no script error may happen there."""
        tab = cls(chromium, **options)
        yield tab
        tab.close()
        assert tab.errors == []

    def sense(self, step: int = 0, **changes: Any) -> None:
        """Let the fake world send a percept."""
        percept = {"values": {"box": [0.5, 2]}, "episode": 1, "step": step, "terms": {}}
        ending = {"terminated": False, "truncated": False}
        self.page.evaluate("each => fake.give(each)", percept | ending | changes)

    def calls(self, name: str) -> list[Any]:
        """Return the arguments of the calls of Python or the world with a name."""
        script = (
            "name => fake.calls.filter((each) => each[0] === name).map((each) => each.slice(1))"
        )
        found: list[Any] = self.page.evaluate(script, name)
        return found

    def fail(self, text: str, line: int, kind: str) -> None:
        """Let the next decision be a mistake."""
        self.page.evaluate(
            """([text, line, kind]) => (fake.decide = () =>
              ({ ok: false, text, line, kind, printed: "", lines: [1], variables: {} }))""",
            [text, line, kind],
        )

    @property
    def state(self) -> Locator:
        return self.page.locator(".ai4u-code-state")

    @property
    def mistake(self) -> Locator:
        return self.page.locator(".ai4u-code-mistake")
