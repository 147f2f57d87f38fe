"""Limits of what a page can say, known to the server and to the viewer."""

MAX_EXACT_INT = 2**53 - 1
"""Largest whole number that a browser represents exactly (``Number.MAX_SAFE_INTEGER``)."""
