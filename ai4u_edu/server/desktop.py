"""Opening the page for the person who started it."""

import os
import sys
import webbrowser


def open_on_desktop(url: str) -> bool:
    """Opens a page in the browser where there is a desktop; whether it did."""
    # elsewhere a browser for the terminal might open, and take it over
    desktop = sys.platform in {"win32", "darwin"} or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )
    return desktop and webbrowser.open(url)
