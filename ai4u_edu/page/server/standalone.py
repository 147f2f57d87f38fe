"""Pages without viser, which need no inline scripts and styles, with a policy."""

from functools import lru_cache

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from starlette.responses import HTMLResponse

from ai4u_edu.base.html_template import with_texts
from ai4u_edu.page.server.page import FRAME_ANCESTORS, with_catalogue
from ai4u_edu.page.server.web_files import ALWAYS_ASK, WebFiles, web_folder

STANDALONE_POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "connect-src 'self'",
        "font-src 'self'",
        "img-src 'self' data:",
        "frame-src 'self'",
        "base-uri 'none'",
        "form-action 'self'",
        FRAME_ANCESTORS,
    ]
)


def standalone_page(name: str) -> HTMLResponse:
    """Return a page of ``web/pages/`` in the reader's language."""
    headers = {"Content-Security-Policy": STANDALONE_POLICY, "Vary": "Accept-Language"}
    return HTMLResponse(WebFiles().versioned(page_text(name)), headers=headers | ALWAYS_ASK)


def page_text(name: str, **values: str) -> str:
    """Return the HTML of a page of ``web/pages/`` in the reader's language.

    Args:
        name: its file's name.
        values: texts by their names in the file.
    """
    return with_catalogue(_templates().get_template(name).render(values))


@lru_cache(maxsize=1)
def _templates() -> Environment:
    return with_texts(
        Environment(
            loader=FileSystemLoader(web_folder() / "pages"),
            autoescape=True,
            undefined=StrictUndefined,
            keep_trailing_newline=True,
        )
    )
