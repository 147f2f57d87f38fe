"""Where an agent's eye is, and where it looks: for a camera that sees what the agent could see."""

import math

import numpy as np
from viser import SceneApi

from ai4u_edu.snapshot import AgentState, BodyState, StaticScene
from ai4u_edu.viewer.scene.layers import Layers

EYE_VIEW = math.radians(65)
"""Vertical."""
EYE_NEAR = 0.05
"""What is closer to the eye (m) isn't drawn."""
EYE_FAR = 12.0
"""What is farther isn't drawn either; as a multiple of the arena's size."""
LOOKS_DOWN = 0.12
"""How far the eye looks down, metres for each metre ahead."""

SKY = np.linspace((132, 170, 206), (226, 235, 242), 64).astype(np.uint8)[:, None]
"""What is behind everything: 64 x 1 pixels, bluest on top."""
LAMPS = (((1.0, 0.55, 0.0), 2.6), ((-1.0, -0.55, 0.0), 1.6), ((-0.55, 1.0, 0.0), 2.0))
"""Where light comes from, level with the ground, and how much: nothing else lights up walls, and
what faces up gets none of it."""

Place = tuple[float, float, float]


class Daylight:
    """What a page needs besides its camera to see as an eye does: a sky, and light on walls.

    Args:
        scene: the page's.
    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        scene.set_background_image(SKY, format="png")
        self._lamps = [
            scene.add_light_directional(f"/daylight/{number}", intensity=much, position=place)
            for number, (place, much) in enumerate(LAMPS)
        ]

    def remove(self) -> None:
        """Takes both away."""
        self._scene.set_background_image(None)
        for lamp in self._lamps:
            lamp.remove()


def eye(static_scene: StaticScene, agent: AgentState, body: BodyState) -> tuple[Place, Place]:
    """The place of an agent's eye, and a place a metre ahead of it; world frame, metres.

    It is the eye of its first ray sensor; without one, it is on its brow.
    """
    eyes = [sense.eye for sense in agent.sensor_infos if sense.eye is not None]
    forward, left, up = eyes[0] if eyes else _brow(static_scene, body)
    cos, sin = math.cos(body.heading), math.sin(body.heading)
    x, y = body.x + cos * forward - sin * left, body.y + sin * forward + cos * left
    z = body.z + Layers.of(static_scene).body + up  # as high as its body is drawn
    return (x, y, z), (x + cos, y + sin, z - LOOKS_DOWN)


def _brow(static_scene: StaticScene, body: BodyState) -> Place:
    (height,) = (each.height for each in static_scene.bodies if each.name == body.name)
    return 0.0, 0.0, 0.8 * height
