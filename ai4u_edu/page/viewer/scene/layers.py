"""Small height differences between flat things on top of each other, against z-fighting.

Seen from above, the differences are invisible. They must exceed the depth buffer's resolution,
which gets coarser with the camera's distance and so with the arena's size.
"""

from dataclasses import dataclass

from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.snapshot import StaticScene


@dataclass(frozen=True)
class Layers:
    """Heights (m) above the thing underneath."""

    unit: float
    """The smallest difference that the depth buffer resolves safely."""
    void: float
    """Height of the background plane, below everything else."""

    @classmethod
    def of(cls, static_scene: StaticScene) -> "Layers":
        """Return the layers for a static scene."""
        unit = arena_size(static_scene) / 2500
        deepest = min(static_scene.settings.fall_threshold, static_scene.lowest_floor)
        return cls(unit, deepest - 5.0 - 20 * unit)

    @property
    def floor_shadow(self) -> float:
        """A floor's shadow, a stack of layers eight units high."""
        return -11 * self.unit

    @property
    def floor_side(self) -> float:
        """A floor's side, drawn flat below the floor as if seen at a slant."""
        return -2 * self.unit

    @property
    def rim(self) -> float:
        """A floor's edge; below the floors, so it is hidden where two floors meet."""
        return -self.unit

    @property
    def floor_plate(self) -> float:
        """An invisible plate under a floor's surface, to click on the floor."""
        return -4 * self.unit

    @property
    def area_plate(self) -> float:
        """An invisible plate under the surface below an area, to click on the area."""
        return -3 * self.unit

    @property
    def grid(self) -> float:
        """The grid on a floor."""
        return self.unit

    def picture(self, share: float) -> float:
        """Return the height of a picture on the ground, 0 for the lowest to 1: under all paint."""
        return (1.75 + 0.25 * share) * self.unit

    @property
    def paint(self) -> float:
        """The fill of a painted area."""
        return 2.25 * self.unit

    @property
    def ink(self) -> float:
        """Ink on a floor; below areas, which are translucent."""
        return 2.5 * self.unit

    @property
    def area(self) -> float:
        """The fill of an area."""
        return 3 * self.unit

    @property
    def outline(self) -> float:
        """The outline of an area."""
        return 3.5 * self.unit

    @property
    def shadow(self) -> float:
        """A body's shadow, a stack of layers five units high."""
        return 4 * self.unit

    @property
    def trail(self) -> float:
        """The trail behind an agent."""
        return 10 * self.unit

    @property
    def body(self) -> float:
        """A body's underside."""
        return 11 * self.unit
