"""The part "view": what the page's picture shows."""

from typing import Literal

from ai4u_edu.page.panel.page_view import CameraMode
from ai4u_edu.page.panel.parts.part import PanelPart


class ViewPart(PanelPart, frozen=True, kw_only=True):
    """The choices for the page's picture."""

    name: Literal["view"] = "view"
    camera: CameraMode
    """Position of the camera."""
    has_trail: bool
    """True if the trail of the agent that is shown is drawn."""
