"""Pages with HTML of a test's own in place of viser's scene and panel."""

import re

from playwright.sync_api import Page, Route

VISERS_CODE = re.compile(r"<script(?![^>]*\bsrc=)[^>]*>.*?</script>", re.DOTALL)
ROOT = '<div id="root">'
KEPT_HEADERS = {"content-security-policy", "cache-control", "etag", "set-cookie"}


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

    def serve(self, page: Page, url: str | re.Pattern[str]) -> None:
        """Have a page show this one at a room's address, with any query; or wherever one fits."""
        if isinstance(url, str):
            url = re.compile(re.escape(url) + r"(\?.*)?$")
        # not a function: then each of the page's requests would come here to ask
        page.route(url, self._answer)

    def _answer(self, route: Route) -> None:
        headers = {**route.request.headers, "if-none-match": self._etag}
        response = route.fetch(headers=headers)
        if response.status != 304:
            text, count = VISERS_CODE.subn("", response.text())
            assert count
            assert ROOT in text
            self._etag = response.headers["etag"]
            self._html = text.replace(ROOT, self._root)
        kept = {key: text for key, text in response.headers.items() if key in KEPT_HEADERS}
        route.fulfill(headers=kept, body=self._html, content_type="text/html")


WITHOUT_VISER = PlainPage(ROOT)
"""The page with our own parts only."""
