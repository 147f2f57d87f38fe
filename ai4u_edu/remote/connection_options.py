"""The options, notes and errors that the synchronous and the asynchronous connection share."""

import errno
import logging
import re
from socket import EAI_AGAIN, gaierror
from typing import Any

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.steps import ConnectionLostError
from ai4u_edu.wire import native

_MAX_BODY_CHARS = 400
_REFUSED = re.compile(rf"^Multiple exceptions: (\[Errno {errno.ECONNREFUSED}\][^\[]*)+$")
"""Text of asyncio's error for a name with several addresses, if nobody listens at any of them."""

_logger = logging.getLogger("ai4u_edu.remote")
_silent = logging.getLogger("ai4u_edu.remote.websockets")
_silent.setLevel(logging.CRITICAL + 1)  # a lost connection is normal: the dialogue reconnects

OPTIONS: dict[str, Any] = {
    "subprotocols": [Subprotocol(native.SUBPROTOCOL)],
    "compression": None,  # frames are small, and numbers compress badly
    "max_size": native.MAX_WORLD_FRAME_BYTES,
    # seconds; a server that vanished without closing the connection is noticed by these pings
    "ping_interval": 2,
    "ping_timeout": 4,
    "close_timeout": 0.5,
    "logger": _silent,
}


def log_note(text: str) -> None:
    """Log a note; a program that configures no logging prints it to stderr.

    A dialogue notes each thing that it waits for once, so a process that serves worlds, too, need
    not limit these lines as it limits others (:func:`ai4u_edu.base.log_limit.limited_logs`).
    """
    _logger.warning("%s", text, extra={"is_limited": True})


def authorization(token: str) -> dict[str, str]:
    """Return the handshake's headers with a world's token: a class's gateway reads it there.

    A header can't hold every token; those of a class are plain.
    """
    is_plain = token.isascii() and token.isprintable() and " " not in token
    return {"Authorization": f"Bearer {token}"} if token and is_plain else {}


def connection_lost_from(error: Exception) -> ConnectionLostError:
    """Convert an error of websockets or of the system."""
    if isinstance(error, ConnectionClosed) and error.rcvd is not None:
        code = error.rcvd.code
        return ConnectionLostError(
            error.rcvd.reason or _("closed with code {code}", code=code), code
        )
    if isinstance(error, InvalidStatus):
        status = error.response.status_code
        body = (error.response.body or b"").decode(errors="replace").strip()
        answer = f"answer {status} {body[:_MAX_BODY_CHARS]}".strip()
        # 5xx: a proxy whose world is about to start
        return ConnectionLostError(answer, is_permanent=status < 500)
    if isinstance(error, ConnectionRefusedError) or _REFUSED.search(str(error)):
        return ConnectionLostError(_("connection refused: nothing listens there"))
    is_unknown_host = isinstance(error, gaierror) and error.errno != EAI_AGAIN
    return ConnectionLostError(str(error) or type(error).__name__, is_permanent=is_unknown_host)
