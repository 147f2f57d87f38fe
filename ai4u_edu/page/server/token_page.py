"""The page with a box for the token, for people who open a protected room without it."""

from starlette.requests import HTTPConnection
from starlette.responses import HTMLResponse, Response

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from ai4u_edu.page.server.standalone import STANDALONE_POLICY, page_text

WRONG = _("That token is wrong.")
PUBLIC_FILES = (
    "fonts/atkinson_hyperlegible_next.woff2",
    "fonts/atkinson_hyperlegible_next_extended.woff2",
    "pages/token.js",
    "shared/scheme.js",
    "shared/text.js",
    "styles/font.css",
    "styles/standalone.css",
)
"""Files of the page, which a browser gets without a token."""


class TokenPage:
    """The page that asks for the token."""

    def response(self, *, is_wrong: bool, wait_s: int) -> Response:
        """Return the page.

        Args:
            is_wrong: True if a wrong token was given.
            wait_s: seconds to wait after too many wrong tokens; 0 if there were not.
        """
        problem = WRONG if is_wrong else ""
        if wait_s:
            problem = _(
                "Too many wrong tokens came from this address. Try again in {seconds} s.",
                seconds=wait_s,
            )
        page = page_text("token.html", problem=translate(problem))
        headers = {"Content-Security-Policy": STANDALONE_POLICY, "Vary": "Accept, Accept-Language"}
        return HTMLResponse(page, headers=headers)


def wants_page(connection: HTTPConnection) -> bool:
    """Return True if a browser asks for a page to show, and not a program for an answer."""
    return connection.scope["type"] == "http" and any(
        part.partition(";")[0].strip().lower() == "text/html"
        for part in connection.headers.get("accept", "").split(",")
    )
