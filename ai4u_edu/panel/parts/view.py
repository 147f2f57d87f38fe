"""The part "view": what the page's picture shows."""

from typing import Any

from ai4u_edu.panel.messages.play import CameraMode


def view_part(camera: CameraMode, *, has_trail: bool) -> dict[str, Any]:
    """Return the choices for the page's picture.

    Args:
        camera: position of the camera.
        has_trail: True if the trail of the agent that is shown is drawn.
    """
    return {"type": "part", "name": "view", "camera": camera, "has_trail": has_trail}
