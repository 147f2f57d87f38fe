"""A world as a tile of JupyterLab: jupyter-server-proxy starts it on a student's own server."""

import secrets
import sys
from typing import Any

from ai4u_edu.cli.play_options import TOKEN_VARIABLE

START_TIMEOUT_S = 60


def server_proxy() -> dict[str, Any]:
    """Return the settings of the server ``ai4u-edu`` for jupyter-server-proxy.

    Other users of the machine may reach the world's port. So it asks for a token, which is in no
    command line, and which the proxy adds for those who may use the student's server.
    """
    from ai4u_edu.member import is_at_hub

    token = secrets.token_urlsafe(24)
    # any host name: the proxy passes on that of the hub
    command = [sys.executable, "-m", "ai4u_edu", "play", "--no-open", "--allow-host", "*"]
    return {
        "command": [*command, "--port", "{port}", *(["--class", "hub"] if is_at_hub() else [])],
        "environment": {TOKEN_VARIABLE: token},
        "request_headers_override": {"Authorization": f"Bearer {token}"},
        "timeout": START_TIMEOUT_S,
        "launcher_entry": {"title": "AI4U Edu"},
    }
