"""What the ray sensors share: codes of groups, and a picture of the last cast for the viewer."""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt
from pydantic import Field

from ai4u_edu.base.parameters import Bits, Degrees, Metres, Name, PositiveMetres, quantity
from ai4u_edu.blocks.sensors.sensor import Sensor

Code = Annotated[int, Field(ge=0, le=255)]


class RayPicture(NamedTuple):
    """The rays of the last reading, to be drawn."""

    origin: tuple[float, float, float]
    """The eye, world frame, metres."""
    ends: npt.NDArray[np.float64]
    """(n, 3) where each ray ends: at what it met, or at its full length."""
    groups: tuple[str, ...]
    """What each ray met: a key of ``group_code``; empty for nothing, ``?`` for something else."""


class RaySensor(Sensor):
    """The parameters that both ray sensors have."""

    abstract = True

    field_of_view: Annotated[float, quantity("deg", gt=0, le=360)] = 90.0
    """The whole horizontal angle."""
    horizontal_shift: Degrees = 0.0
    """Turns the whole fan clockwise."""
    eye: tuple[Metres, Metres, Metres] = (0.0, 0.0, 0.5)
    """Place of the eye on the body: (forward, left, up) of its centre and underside, in metres."""
    vision_max_distance: PositiveMetres = 30.0
    """Length of a ray; what is farther away is not met."""
    group_code: dict[Name, Code] = Field(default_factory=dict)
    """Code, 0..255, of each group (tag); of a body with several tags, the first one counts."""
    no_object_code: Code = 0
    """Code of a ray that meets nothing, or something that has no code of its own."""
    return_distance: bool = False
    """True reads the distance to what each ray meets as well."""
    normalize_distance: bool = True
    """True reads distances as a share of vision_max_distance, False in metres."""
    self_exclude: bool = True
    """True lets rays pass through the agent's own body."""
    collision_mask: Bits = 0xFFFFFFFF
    """Bits of the collision layers that a ray can meet."""
    normalized: bool = True
    """True reads codes as a share of the largest one in use, False as they are."""

    looks_at: ClassVar[tuple[str, ...]] = ("bodies", "floors")

    def code_of(self, tags: Sequence[str]) -> float:
        """The code of something with these tags."""
        for tag in tags:
            if tag in self.group_code:
                return float(self.group_code[tag])
        return float(self.no_object_code)

    @property
    def largest_code(self) -> float:
        """The largest code that a ray can read; at least 1."""
        return float(max(1, self.no_object_code, *self.group_code.values()))

    @property
    def farthest(self) -> float:
        """The largest distance that can be read."""
        return 1.0 if self.normalize_distance else self.vision_max_distance

    def capture(self) -> Callable[[], RayPicture]:
        """Makes the picture of the last reading when it is called, and as often as it is.

        It has numbers of its own, and holds on to neither the sensor nor its world.
        """
        raise NotImplementedError  # each ray sensor has its own

    def picture(self) -> RayPicture:
        """The rays of the last reading."""
        return self.capture()()

    def _options(self) -> dict[str, Any]:
        return {
            "eye": self.eye,
            "mask": self.collision_mask,
            "exclude_self": self.self_exclude,
        }

    def _names(self) -> dict[float, str]:
        return {float(code): name for name, code in reversed(self.group_code.items())}


def groups_met(
    names: Mapping[float, str], codes: npt.NDArray[np.float64], hit: npt.NDArray[np.bool_]
) -> tuple[str, ...]:
    """What each ray met, as a :class:`RayPicture` has it."""
    return tuple(
        names.get(code, "?") if met else ""
        for code, met in zip(codes.tolist(), hit.tolist(), strict=True)
    )


def spread(count: int, field_of_view: float) -> npt.NDArray[np.float64]:
    """Angles (radians) of ``count`` rays, evenly inside a field of view (degrees), rising.

    >>> np.degrees(spread(3, 120)).round().tolist()
    [-30.0, 0.0, 30.0]
    """
    steps = np.arange(1, count + 1) / (count + 1)
    angles: npt.NDArray[np.float64] = np.radians(field_of_view) * (steps - 0.5)
    return angles
