"""The page's panel: its state as JSON, and the commands that a page may send."""

from ai4u_edu.panel.context import PanelContext
from ai4u_edu.panel.socket import PanelSockets

__all__ = ["PanelContext", "PanelSockets"]
