"""Limits and defaults that several packages share."""

MAX_EXACT_INT = 2**53 - 1
"""Largest whole number that a browser represents exactly (``Number.MAX_SAFE_INTEGER``)."""
DEFAULT_KEPT_EPISODES = 50
"""Recorded episodes that are kept in memory."""
