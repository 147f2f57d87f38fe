"""How things that lie on each other are kept apart, so that they don't flicker through each other.

Seen from straight above a small lift doesn't show. It has to be more than the depth buffer can tell
apart, and that grows with the camera's distance, and so with the size of the arena.
"""

from dataclasses import dataclass

from ai4u_edu.snapshot import StaticScene
from ai4u_edu.viewer.scene.placing import lowest_floor, size


@dataclass(frozen=True)
class Layers:
    """Heights (metres) above what something lies on."""

    unit: float
    void: float
    """The height of the bottom of everything."""

    @classmethod
    def of(cls, static_scene: StaticScene) -> "Layers":
        """The layers of a static_scene."""
        unit = size(static_scene) / 2500
        deepest = min(static_scene.settings.fall_threshold, lowest_floor(static_scene))
        return cls(unit, deepest - 5.0 - 20 * unit)

    @property
    def floor_shadow(self) -> float:
        """What a floor throws on what is below: a pile of sheets, eight units high."""
        return -11 * self.unit

    @property
    def cliff(self) -> float:
        """A floor's side, drawn as if one could see it."""
        return -2 * self.unit

    @property
    def rim(self) -> float:
        """A floor's edge; under the floors, so that it shows only where no other floor joins."""
        return -self.unit

    @property
    def grid(self) -> float:
        """Lines on a floor."""
        return self.unit

    @property
    def paint(self) -> float:
        """What is painted on a floor."""
        return 1.5 * self.unit

    @property
    def area(self) -> float:
        """The fill of an area."""
        return 2 * self.unit

    @property
    def outline(self) -> float:
        """The outline of an area."""
        return 3 * self.unit

    @property
    def shadow(self) -> float:
        """What a body throws: a pile of sheets, five units high."""
        return 4 * self.unit

    @property
    def body(self) -> float:
        """A body's underside."""
        return 11 * self.unit
