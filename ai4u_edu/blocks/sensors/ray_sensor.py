"""The base of the ray sensors: codes of groups, and a picture of the last cast for the viewer."""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import Bits, Degrees, Metres, Name, PositiveMetres, quantity
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Cast

Code = Annotated[int, Field(ge=0, le=255)]


class RayPicture(NamedTuple):
    """The rays of the last reading, to be drawn."""

    origin: tuple[float, float, float]
    """Position of the eye, world frame, metres."""
    ends: npt.NDArray[np.float64]
    """(n, 3) end point of each ray: where it hit something, or at its full length."""
    groups: tuple[str, ...]
    """The group that each ray hit (a key of ``group_code``); empty if none, ``?`` without code."""


class RaySensor(Sensor):
    """The parameters that all ray sensors have."""

    abstract = True

    field_of_view: Annotated[float, quantity("deg", gt=0, le=360)] = 90.0
    """The whole horizontal angle."""
    horizontal_shift: Degrees = 0.0
    """Angle by which all rays are turned clockwise."""
    eye: tuple[Metres, Metres, Metres] = (0.0, 0.0, 0.5)
    """Position of the eye: (forward, left) of the body's centre, up from its underside, metres."""
    vision_max_distance: PositiveMetres = 30.0
    """Length of a ray."""
    group_code: dict[Name, Code] = Field(default_factory=dict)
    """Code, 0..255, of each group (tag); of a body's tags, the first that has a code counts."""
    no_object_code: Code = 0
    """Code of a ray that hits nothing, or something without a code."""
    return_code: bool = True
    """True reads the code of what each ray hits; False needs ``return_distance``."""
    return_distance: bool = False
    """True also reads the distance to what each ray hits."""
    normalize_distance: bool = True
    """True reads distances as a share of vision_max_distance, False in metres."""
    self_exclude: bool = True
    """True lets rays pass through the agent's own body."""
    collision_mask: Bits = 0xFFFFFFFF
    """Bits of the collision layers that a ray can hit."""
    normalized: bool = True
    """True reads codes as a share of the largest one in use, False as whole numbers."""

    looks_at: ClassVar[tuple[str, ...]] = ("bodies", "floors")

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.return_code or self.return_distance):
            raise BlockError(
                _(
                    "{type} {perception_key!r}: expected return_code or return_distance, got "
                    "neither",
                    type=type(self).__name__,
                    perception_key=self.perception_key,
                )
            )

    def code_of(self, tags: Sequence[str]) -> float:
        """Return the code of something with these tags."""
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
        """Return a function that makes the picture of the last reading.

        It holds a copy of the numbers, and no reference to the sensor or its world.
        """
        raise NotImplementedError  # each ray sensor has its own

    def picture(self) -> RayPicture:
        """Return the picture of the last reading."""
        return self.capture()()

    def _options(self) -> dict[str, Any]:
        return {
            "eye": self.eye,
            "mask": self.collision_mask,
            "exclude_self": self.self_exclude,
        }

    def _names(self) -> dict[float, str]:
        return {float(code): name for name, code in reversed(self.group_code.items())}


def picture_of(
    cast: Cast, pitches: npt.NDArray[np.float64], reach: float, names: Mapping[float, str]
) -> RayPicture:
    """Return the picture of a cast.

    Args:
        cast: codes and distances of (rows, columns), or of one row.
        pitches: of each row, radians, upwards positive.
        reach: length of a ray that hits nothing, metres.
        names: the group of each code.
    """
    hit = cast.distances > 0
    length = np.where(hit, cast.distances, reach)
    along = length * np.cos(pitches)[:, None]
    x, y, z = cast.origin
    ends = np.stack(
        [
            x + along * cast.directions[:, 0],
            y + along * cast.directions[:, 1],
            z + length * np.sin(pitches)[:, None],
        ],
        axis=-1,
    )
    groups = _groups_met(names, cast.codes.ravel(), hit.ravel())
    return RayPicture(cast.origin, ends.reshape(-1, 3), groups)


def _groups_met(
    names: Mapping[float, str], codes: npt.NDArray[np.float64], hit: npt.NDArray[np.bool_]
) -> tuple[str, ...]:
    """Return the group that each ray hit, as in :class:`RayPicture`."""
    return tuple(
        names.get(code, "?") if met else ""
        for code, met in zip(codes.tolist(), hit.tolist(), strict=True)
    )


def spread(count: int, field_of_view: float) -> npt.NDArray[np.float64]:
    """Return the angles (radians) of rays spread evenly over a field of view (degrees), rising.

    >>> np.degrees(spread(3, 120)).round().tolist()
    [-30.0, 0.0, 30.0]
    """
    steps = np.arange(1, count + 1) / (count + 1)
    angles: npt.NDArray[np.float64] = np.radians(field_of_view) * (steps - 0.5)
    return angles
