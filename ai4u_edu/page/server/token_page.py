"""The page with a box for the token, for people who open a protected room without it."""

import html

from starlette.requests import HTTPConnection
from starlette.responses import HTMLResponse, Response

from ai4u_edu.page.server.standalone import STANDALONE_POLICY
from ai4u_edu.page.server.web_files import web_folder

WRONG = "That token is wrong."
TOO_MANY = "Too many wrong tokens came from this address. Try again in {seconds} s."
PUBLIC_FILES = ("shared/scheme.js", "styles/standalone.css", "pages/token.js")
"""Files of the page, which a browser gets without a token."""
_PLACE = "<!--problem-->"


class TokenPage:
    """The page that asks for the token."""

    def __init__(self) -> None:
        self._text = (web_folder() / "pages" / "token.html").read_text(encoding="utf-8")

    def response(self, *, is_wrong: bool, wait_s: int) -> Response:
        """Return the page.

        Args:
            is_wrong: True if a wrong token was given.
            wait_s: seconds to wait after too many wrong tokens; 0 if there were not.
        """
        problem = TOO_MANY.format(seconds=wait_s) if wait_s else WRONG if is_wrong else ""
        text = self._text.replace(_PLACE, html.escape(problem))
        headers = {"Content-Security-Policy": STANDALONE_POLICY, "Vary": "Accept"}
        return HTMLResponse(text, headers=headers)


def wants_page(connection: HTTPConnection) -> bool:
    """Return True if a browser asks for a page to show, and not a program for an answer."""
    return connection.scope["type"] == "http" and any(
        part.partition(";")[0].strip().lower() == "text/html"
        for part in connection.headers.get("accept", "").split(",")
    )
