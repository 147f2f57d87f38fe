"""Policy of pages without viser, which need no inline scripts and styles."""

from ai4u_edu.server.page import FRAME_ANCESTORS

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
