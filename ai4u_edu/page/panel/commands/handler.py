"""Type of the functions that carry out commands."""

from collections.abc import Awaitable, Callable
from typing import Any

from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.page import Page

Handler = Callable[[Page, Any], Awaitable[Answer]]
"""Carries out a command of one type, in the server's event loop."""
