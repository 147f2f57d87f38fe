"""What both kinds of lines have in common."""

import logging
from socket import gaierror
from typing import Any

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from ai4u_edu.remote.steps import LineLost
from ai4u_edu.wire import native

_logger = logging.getLogger("ai4u_edu.remote")
_logger.setLevel(logging.CRITICAL)  # a lost connection is an everyday thing, and dealt with

OPTIONS: dict[str, Any] = {
    "subprotocols": [Subprotocol(native.SUBPROTOCOL)],
    "compression": None,  # frames are small, and numbers hardly shrink
    "max_size": native.LARGEST_HEARD,
    # an end that has vanished without a word is found out so
    "ping_interval": 2,
    "ping_timeout": 4,
    "close_timeout": 0.5,
    "logger": _logger,
}


def lost_by(error: Exception) -> LineLost:
    """A lost line, by what websockets or the system said."""
    if isinstance(error, ConnectionClosed) and error.rcvd is not None:
        return LineLost(error.rcvd.reason or f"closed with code {error.rcvd.code}", error.rcvd.code)
    if isinstance(error, InvalidStatus):
        body = (error.response.body or b"").decode(errors="replace").strip()
        return LineLost(f"answer {error.response.status_code} {body[:400]}".strip(), for_good=True)
    nobody = isinstance(error, ConnectionRefusedError | gaierror)
    return LineLost(str(error) or type(error).__name__, for_good=nobody)
