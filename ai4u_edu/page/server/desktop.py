"""Open the page in the browser of the person who started the server."""

import os
import sys
import webbrowser


def open_on_desktop(url: str) -> bool:
    """Open a page if there is a desktop; return True if it was opened."""
    # without a desktop a text browser might open, and take over the terminal
    desktop = sys.platform in {"win32", "darwin"} or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )
    return desktop and webbrowser.open(url)
