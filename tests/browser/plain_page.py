"""Pages with HTML of a test's own in place of viser's scene and panel."""

import re
from collections.abc import Mapping

from playwright.sync_api import Page, Route
from starlette.middleware.base import BaseHTTPMiddleware, RequestResponseEndpoint
from starlette.requests import Request
from starlette.responses import Response
from starlette.types import ASGIApp

VISERS_CODE = re.compile(r"<script(?![^>]*\b(?:src=|id=.ai4u-texts))[^>]*>.*?</script>", re.DOTALL)
ROOT = '<div id="root">'
KEPT_HEADERS = {"content-security-policy", "cache-control", "etag", "set-cookie"}
ASKED = {"x-plain-page": "yes"}
"""Headers of a browser that asks a room of the test's own process for such a page."""


class PlainPage:
    """A room's page without viser's code, which is the most of it by far.

    The headers are the room's. What is left of the text is kept as long as the room says that its
    page is the same, since to read some megabytes takes longer than most tests.
    """

    def __init__(self, root: str) -> None:
        """
        Args:
            root: HTML in place of the element into which viser draws.
        """
        self._root = root
        self._etag = self._html = ""

    def app(self, app: ASGIApp) -> ASGIApp:
        """Return a room's app with this page for browsers that ask for it.

        Where that can be had it is better than :meth:`serve`, which has the browser ask the test
        before each request, and keep no file.
        """
        return BaseHTTPMiddleware(app, self._serve_instead)

    def serve(self, page: Page, url: str | re.Pattern[str]) -> None:
        """Have a page show this one at a room's address, with any query; or wherever one fits."""
        if isinstance(url, str):
            url = re.compile(re.escape(url) + r"(\?.*)?$")
        # not a function: then each of the page's requests would come here to ask
        page.route(url, self._answer)

    async def _serve_instead(
        self, request: Request, call_next: RequestResponseEndpoint
    ) -> Response:
        response = await call_next(request)
        is_page = response.headers.get("content-type", "").startswith("text/html")
        is_asked = ASKED.items() <= dict(request.headers).items()
        if not (is_page and is_asked and "etag" in response.headers):  # other pages have none
            return response
        if response.headers["etag"] != self._etag:
            chunks = [bytes(each) async for each in response.body_iterator]  # type: ignore[attr-defined]
            self._keep(b"".join(chunks).decode(), response.headers["etag"])
        return Response(self._html, headers=_kept(response.headers), media_type="text/html")

    def _answer(self, route: Route) -> None:
        headers = {**route.request.headers, "if-none-match": self._etag}
        response = route.fetch(headers=headers)
        if response.status != 304:
            self._keep(response.text(), response.headers["etag"])
        kept = _kept(response.headers)
        route.fulfill(headers=kept, body=self._html, content_type="text/html")

    def _keep(self, text: str, etag: str) -> None:
        text, count = VISERS_CODE.subn("", text)
        assert count
        assert ROOT in text
        self._etag, self._html = etag, text.replace(ROOT, self._root)


def _kept(headers: Mapping[str, str]) -> dict[str, str]:
    return {key: text for key, text in headers.items() if key in KEPT_HEADERS}


WITHOUT_VISER = PlainPage(ROOT)
"""The page with our own parts only."""
CLASS_ROOM = re.compile(r"/r/[\w-]+/(\?.*)?$")
"""Address of any student's room of a class."""
