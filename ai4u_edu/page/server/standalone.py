"""Pages without viser, which need no inline scripts and styles, with a policy."""

from starlette.responses import HTMLResponse

from ai4u_edu.page.server.page import FRAME_ANCESTORS
from ai4u_edu.page.server.web_files import ALWAYS_ASK, WebFiles, web_folder

STANDALONE_POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "connect-src 'self'",
        "img-src 'self' data:",
        "frame-src 'self'",
        "base-uri 'none'",
        "form-action 'self'",
        FRAME_ANCESTORS,
    ]
)


def standalone_page(name: str) -> HTMLResponse:
    """Return a page of ``web/pages/``."""
    text = (web_folder() / "pages" / name).read_text(encoding="utf-8")
    headers = {"Content-Security-Policy": STANDALONE_POLICY, **ALWAYS_ASK}
    return HTMLResponse(WebFiles().versioned(text), headers=headers)
