"""The camera in an agent's eye: its pose, its limits, and the light it needs."""

import math

import numpy as np
from viser import SceneApi

from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.snapshot import AgentState, BodyState, StaticScene

EYE_FIELD_OF_VIEW_RAD = math.radians(65)
"""Vertical field of view."""
EYE_NEAR_M = 0.05
"""Near clipping distance."""
EYE_FAR_IN_ARENAS = 12.0
"""Far clipping distance, as a multiple of the arena's size."""
DOWNWARD_SLOPE = 0.12
"""Slope at which the eye looks down: metres down for each metre ahead."""

SKY = np.linspace((132, 170, 206), (226, 235, 242), 64).astype(np.uint8)[:, None]
"""Background image, 64 x 1 pixels, bluest on top."""
SIDE_LIGHTS = (((1.0, 0.55, 0.0), 2.6), ((-1.0, -0.55, 0.0), 1.6), ((-0.55, 1.0, 0.0), 2.0))
"""Horizontal lights as (direction, intensity): they light walls, which the light from above does
not, and add nothing to surfaces that face up."""

Position = tuple[float, float, float]


class Daylight:
    """A sky and side lights, on one page, while its camera is in an agent's eye.

    Args:
        scene: viser's scene of the page.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        scene.set_background_image(SKY, format="png")
        self._lights = [
            scene.add_light_directional(
                f"/daylight/{number}", intensity=intensity, position=position
            )
            for number, (position, intensity) in enumerate(SIDE_LIGHTS)
        ]

    def remove(self) -> None:
        """Remove the sky and the lights."""
        self._scene.set_background_image(None)
        for light in self._lights:
            light.remove()


def eye_pose(
    static_scene: StaticScene, agent: AgentState, body: BodyState
) -> tuple[Position, Position]:
    """Return the eye's position and a point about 1 m ahead of it; world frame, metres.

    The eye is that of the agent's first ray sensor, else a point near the top of its body.
    """
    eyes = [sensor.eye for sensor in agent.sensor_infos if sensor.eye is not None]
    forward, left, up = eyes[0] if eyes else _default_eye(static_scene, body)
    cos, sin = math.cos(body.heading), math.sin(body.heading)
    x, y = body.x + cos * forward - sin * left, body.y + sin * forward + cos * left
    z = body.z + Layers.of(static_scene).body + up  # bodies are drawn that much higher
    return (x, y, z), (x + cos, y + sin, z - DOWNWARD_SLOPE)


def _default_eye(static_scene: StaticScene, body: BodyState) -> Position:
    (height,) = (each.height for each in static_scene.bodies if each.name == body.name)
    return 0.0, 0.0, 0.8 * height
