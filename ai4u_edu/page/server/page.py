"""viser's page with our scripts and styles inserted.

It is one document without frames, so that no frame keeps keys from the others.
"""

import hashlib
import html
from collections.abc import Awaitable, Callable
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from starlette.requests import Request
from starlette.responses import Response

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import SOURCE, catalogue, library_text, page_catalogue, translate
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.web_files import ALWAYS_ASK, WebFiles

_PLACE = "<title>Viser</title>"
_OURS = """<title>{title}</title>
    <script src="./web/page/dark.js"></script>
    <script src="./web/page/page_id.js"{panel}></script>
    <link rel="preload" href="./web/fonts/atkinson_hyperlegible_next.woff2" as="font"
      type="font/woff2" crossorigin />
    <link rel="stylesheet" href="./web/styles/all.css" />
    <script type="module" src="./web/page/main.js"></script>
    {preloads}"""
STYLES = (
    "styles/font.css",
    "styles/page/page.css",
    "styles/page/dock.css",
    "styles/page/banners.css",
    "styles/page/help.css",
    "styles/panel/panel.css",
    "styles/panel/layout.css",
    "styles/panel/controls.css",
    "styles/panel/run.css",
    "styles/scene_picture.css",
    "styles/panel/cards.css",
    "styles/panel/windows.css",
    "styles/panel/drive.css",
    "styles/panel/build.css",
    "styles/panel/code.css",
    "styles/panel/test.css",
    "styles/panel/blocks.css",
    "styles/stars.css",
    "styles/panel/why.css",
    "styles/panel/maps.css",
    "styles/panel/teach.css",
    "styles/missions.css",
    "styles/question.css",
    "styles/classroom/bar.css",
)
"""Our styles, in the order in which later ones override earlier ones.

A browser gets them as one file: each file costs it, and the server, some milliseconds.
"""
FRAME_ANCESTORS = "frame-ancestors 'self' http://localhost:* http://127.0.0.1:*"
"""Policy for pages that notebooks show in a frame."""


class PageRoutes:
    """Routes of the page and its files.

    Args:
        title: returns the page's present title; any text.
        has_panel: True if the room has a panel; else the page shows viser's own, empty one.

    Raises:
        SetupError: viser's page or our files are missing.
    """

    def __init__(self, title: Callable[[], str], *, has_panel: bool = False) -> None:
        self._files = WebFiles()
        self._modules = self._files.modules("page/main.js", *["panel/panel.js"] * has_panel)
        self._title, self._has_panel = title, has_panel
        self._indexes = {SOURCE: self._read_index()}

    async def index(self, request: Request) -> Response:
        """Return the page in the reader's language."""
        language = catalogue().language
        index = self._indexes.get(language)
        # another scene has been opened, or somebody works on our files
        if index is None or (index.title, index.version) != (self._title(), self._files.version):
            index = self._indexes[language] = self._read_index()
        headers = ALWAYS_ASK | {
            "ETag": index.etag,
            "Vary": "Accept-Language",
            "Content-Security-Policy": _policy(request.headers["host"]),
        }
        if request.headers.get("if-none-match") == index.etag:
            return Response(status_code=304, headers=headers)
        return Response(index.content, media_type="text/html", headers=headers)

    async def styles(self, request: Request) -> Response:
        """Return all styles of the page as one file."""
        return self._files.response(request, *STYLES)

    async def file(self, request: Request) -> Response:
        """Return one of our files."""
        return self._files.response(request, request.path_params["file"])

    def public_file(self, name: str) -> Callable[[Request], Awaitable[Response]]:
        """Return the route of one file."""

        async def route(request: Request) -> Response:
            return self._files.response(request, name)

        return route

    def _read_index(self) -> "_Index":
        """Return the page with its present title."""
        return _index(self._title(), self._modules, self._files, has_panel=self._has_panel)


def with_catalogue(page: str) -> str:
    """Return an HTML page that says its language, and holds the texts of its scripts in it."""
    language = catalogue().language
    texts = page_catalogue(language).replace("<", "\\u003c")  # else it could end the element
    page = page.replace('<html lang="en">', f'<html lang="{language.replace("_", "-")}">', 1)
    element = f'<script type="application/json" id="ai4u-texts">{texts}</script>'
    return page.replace(
        "<title>", f"{element}\n    <title>", 1
    )  # the first one of a page is its own


class _Index(NamedTuple):
    title: str
    version: str
    content: bytes
    etag: str


def _index(title: str, modules: list[str], files: WebFiles, *, has_panel: bool) -> _Index:
    spec = find_spec("viser")
    if spec is None or spec.origin is None:
        raise SetupError(_("expected the package viser, found none; install ai4u-edu again"))
    path = Path(spec.origin).parent / "client" / "build" / "index.html"
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    if text.count(_PLACE) != 1:
        raise SetupError(
            _(
                "expected viser's page with {place} in {path}; install the viser that "
                "ai4u-edu asks for (pip install --force-reinstall ai4u-edu)",
                place=_PLACE,
                path=str(path),
            )
        )
    ours = _OURS.format(
        title=html.escape(translate(library_text(title))),
        panel=" data-panel" if has_panel else "",
        # else a browser finds a module's imports only after it has read the module
        preloads="\n    ".join(
            f'<link rel="modulepreload" href="./web/{each}" />' for each in modules
        ),
    )
    content = with_catalogue(text.replace(_PLACE, files.versioned(ours))).encode()
    return _Index(title, files.version, content, f'"{hashlib.sha256(content).hexdigest()[:32]}"')


def _policy(host: str) -> str:
    # viser's client connects to ?websocket= and ?playbackPath= of the page's address, and a server
    # there could run scripts in the page: so it may connect to us only. viser's code is inline, and
    # starts workers and WebAssembly from blobs.
    return "; ".join(
        [
            "default-src 'self' data: blob:",
            "script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:",
            "style-src 'self' 'unsafe-inline'",
            f"connect-src 'self' data: blob: ws://{host} wss://{host}",
            "object-src 'none'",
            "base-uri 'none'",
            "form-action 'none'",
            FRAME_ANCESTORS,
        ]
    )
