"""The editor of the tab "Code", as tests use it."""

from playwright.sync_api import Locator, Page


class WithEditor:
    """A page with the tab "Code" open."""

    page: Page

    @property
    def editor(self) -> Locator:
        return self.page.get_by_role("textbox", name="Program in Python")

    @property
    def text(self) -> str:
        lines = self.page.locator(".cm-line").evaluate_all("all => all.map(e => e.textContent)")
        return "\n".join(lines)

    def write(self, program: str) -> None:
        """Replace the program, as a person who pastes one does."""
        self.editor.click()
        self.page.keyboard.press("ControlOrMeta+a")
        self.page.keyboard.insert_text(program)

    def press(self, name: str) -> None:
        self.page.get_by_role("button", name=name, exact=True).click()
