"""One tab of the panel on a page of its own, with a fake panel that answers at once."""

import json
import socket
import threading
from collections.abc import Awaitable, Callable, Iterable
from functools import cache
from typing import Any
from urllib.parse import urlencode

import uvicorn
from playwright.sync_api import Browser, ConsoleMessage, Locator, Page
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

from ai4u_edu.locale import language_of_page, reader
from ai4u_edu.page.server.page import STYLES, with_catalogue
from ai4u_edu.page.server.web_files import web_folder
from tests.browser.fake_code import MODULES
from tests.chromium import close_page, quick_page

KEPT = {"Cache-Control": "max-age=3600"}
"""Headers of files that a browser asks for once."""
FREE = "position: static; width: auto; height: auto; max-height: none"
INDEX = """<!doctype html>
<html lang="en" data-mantine-color-scheme="{scheme}" data-ai4u-scheme="{scheme}" {attributes}>
<meta name="viewport" content="width=device-width, initial-scale=1" />
<title>Tab</title>
<link rel="icon" href="data:," />
<style>{styles}</style>
<body style="margin: 0">
<aside class="ai4u-panel" style="{style}">
  <div class="ai4u-panel-body">
    <div style="height: 41px"></div> <!-- the names of the tabs -->
    <div role="tabpanel" class="ai4u-tabpanel"></div>
  </div>
</aside>
{scripts}
<script type="module">
  import {{ openDialog }} from "./web/panel/dialog.js";
  import {{ installShortcuts }} from "./web/panel/shortcuts.js";
  import {{ {name} }} from "./web/{module}.js";

  class FakePanel extends EventTarget {{
    shown = {{ agent: "0", tabs: ["{part}"], block: null, body: null, others: [], episode: null }};
    details = false;
    sent = [];
    answers = {{}};
    notices = [];
    parts = {{}};
    async send(command, args = {{}}) {{
      this.sent.push({{ command, ...args }});
      return {{ ok: true, text: "", problems: [], ...(this.answers[command] ?? {{}}) }};
    }}
    async sendFile(command, file) {{
      return this.send(command, {{ name: file.name, text: await file.text() }});
    }}
    show(changes) {{
      Object.assign(this.shown, changes);
      if (this.parts["{part}"]) tab.update(this.parts["{part}"]);
    }}
    part(name) {{ return this.parts[name] ?? null; }}
    notice(text, level = "info") {{ this.notices.push(`${{level}}: ${{text}}`); }}
    dialog(title, ...children) {{ return openDialog(title, ...children); }}
    openTab() {{}}
    focusWorld() {{}}
    give(name, part) {{
      this.parts[name] = part;
      if (name === "{part}") tab.update(part);
      this.dispatchEvent(new CustomEvent(`part:${{name}}`, {{ detail: part }}));
    }}
  }}
  const panel = (window.panel = new FakePanel());
  installShortcuts(panel);
  if ("{part}" === "world") {{
    const {{ Palette }} = await import("./web/panel/world/palette.js");
    panel.palette = new Palette(panel);
  }}
  const tab = new {name}(document.querySelector("[role=tabpanel]"), panel);
  window.isReady = true;
</script>
"""


class TabPage:
    """A page with one tab.

    Args:
        chromium: opens the page.
        module: name of the tab's module, such as ``panel/build/tab``.
        name: of its class.
        part: name of the part that it shows.
        size: of the page in pixels.
        scheme: ``light`` or ``dark``.
        has_fakes: Python and the world of the tab "Code" are fakes, see :mod:`fake_code`.
        prepare: called with the page before it is opened.
        options: more of ``Browser.new_context``; ``locale`` is the tab's language.
    """

    def __init__(
        self,
        chromium: Browser,
        module: str,
        name: str,
        part: str,
        *,
        size: tuple[int, int] = (340, 720),
        scheme: str = "light",
        has_details: bool = False,
        has_fakes: bool = False,
        prepare: Callable[[Page], None] = lambda _: None,
        **options: Any,
    ) -> None:
        self.part_name = part
        self.page: Page = quick_page(chromium, *size, draws=True, **options)
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", self._on_console)
        prepare(self.page)
        attributes = "data-ai4u-details" if has_details else ""
        query = {"module": module, "name": name, "part": part, "scheme": scheme}
        path = "fakes/" if has_fakes else ""
        self.page.goto(f"{_address()}{path}?{urlencode(query | {'attributes': attributes})}")
        self.page.wait_for_function("window.isReady")

    def close(self) -> None:
        """Close the page."""
        close_page(self.page)

    def head(self, title: str) -> Locator:
        """Return the button that opens a card."""
        return self.page.locator("button[aria-expanded]").filter(
            has=self.page.locator(f"strong:text-is('{title}')")
        )

    def give(self, part: dict[str, Any], name: str = "") -> None:
        """Send a part to the tab."""
        self.page.evaluate(
            "([name, part]) => panel.give(name, part)", [name or self.part_name, part]
        )

    def answer(self, command: str, **answer: Any) -> None:
        """Set the answer to a command."""
        self.page.evaluate(
            "([command, answer]) => (panel.answers[command] = answer)", [command, answer]
        )

    def sent(self) -> list[dict[str, Any]]:
        """Return the commands that were sent since the last call."""
        sent: list[dict[str, Any]] = json.loads(
            self.page.evaluate("JSON.stringify(panel.sent.splice(0))")
        )
        return sent

    @property
    def shown(self) -> dict[str, Any]:
        """Parts of the world that the page looks at."""
        shown: dict[str, Any] = self.page.evaluate("panel.shown")
        return shown

    def small_controls(self, smallest: float) -> list[str]:
        """Return the visible controls that are lower than ``smallest`` pixels."""
        script = """smallest => [...document.querySelectorAll(
            "button, input, select, textarea, summary, a[href]")]
          .filter(each => each.checkVisibility() && each.type !== "checkbox")
          .filter(each => each.getBoundingClientRect().height < smallest)
          .map(each => each.outerHTML.slice(0, 120))"""
        found: list[str] = self.page.evaluate(script, smallest)
        return found

    def unnamed_controls(self) -> list[str]:
        """Return the visible controls without an accessible name."""
        script = """() => [...document.querySelectorAll("button, input, select, textarea, a[href]")]
          .filter(each => each.checkVisibility())
          .filter(each => !(each.ariaLabel || each.textContent.trim() || each.labels?.length))
          .map(each => each.outerHTML.slice(0, 120))"""
        found: list[str] = self.page.evaluate(script)
        return found

    def _on_console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.errors.append(message.text)


@cache
def _address() -> str:
    """Start the server of all tabs, which ends with the process; return its address."""

    others_too = {"styles/font.css", "styles/page/page.css"}
    names = [name for name in STYLES if "/panel/" in name or name in others_too]
    styles = "\n".join((web_folder() / name).read_text(encoding="utf-8") for name in names)
    styles = styles.replace("../fonts/", "/web/fonts/")
    files = [
        Mount(f"/web/{folder}", StaticFiles(directory=web_folder() / folder))
        for folder in ("fonts", "vendor")
    ]

    def routes(others: dict[str, str]) -> list[BaseRoute]:
        return [
            Route("/", _index(styles, others)),
            *files,
            Route("/web/{name:path}", _module(others)),
        ]

    app = Starlette(routes=[Mount("/fakes", routes=routes(MODULES)), *routes({})])
    # not ServerThread, which limits the process's logs for as long as it runs
    server = uvicorn.Server(uvicorn.Config(app, log_config=None, lifespan="off"))
    listener = socket.create_server(("127.0.0.1", 0))
    threading.Thread(target=server.run, args=([listener],), daemon=True).start()
    return f"http://127.0.0.1:{listener.getsockname()[1]}/"


def _index(styles: str, first: Iterable[str]) -> Callable[[Request], Response]:
    """Return the route of the page; some modules are loaded before a test can use it."""
    scripts = "".join(f'<script type="module" src="web/{name}"></script>' for name in first)

    def route(request: Request) -> Response:
        texts = {"styles": styles, "style": FREE, "scripts": scripts, **request.query_params}
        with reader(language_of_page(request.headers.get("accept-language", ""))):
            return HTMLResponse(with_catalogue(INDEX.format_map(texts)))

    return route


def _module(others: dict[str, str]) -> Callable[[Request], Awaitable[Response]]:
    """Return the route of our modules; others stand in the place of some."""

    async def route(request: Request) -> Response:
        name = request.path_params["name"]
        text = others.get(name) or (web_folder() / name).read_text(encoding="utf-8")
        return Response(text, headers=KEPT, media_type="text/javascript")

    return route
