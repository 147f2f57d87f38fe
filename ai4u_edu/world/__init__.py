"""The physics; no other package uses pymunk."""

from ai4u_edu.world.body import Body, BodyView
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    EasyRanges,
    FloorDescription,
    RegionDescription,
    Variation,
    WorldSettings,
)
from ai4u_edu.world.edit import (
    Pose,
    edit_body,
    insert_body,
    put_region,
    redescribe,
    reorder,
    sampled_region,
)
from ai4u_edu.world.fields import AnyField, FieldDescription, LineField, MazeField, RescueField
from ai4u_edu.world.rays import Cast, RayFan, RayGrid
from ai4u_edu.world.region import Region
from ai4u_edu.world.shapes import (
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    RingShape,
    SegmentShape,
)
from ai4u_edu.world.view import WorldView
from ai4u_edu.world.world import World

__all__ = [
    "AnyField",
    "AreaDescription",
    "Body",
    "BodyDescription",
    "BodyView",
    "BoxShape",
    "CapsuleShape",
    "Cast",
    "CircleShape",
    "EasyRanges",
    "FieldDescription",
    "FloorDescription",
    "LineField",
    "MazeField",
    "PolygonShape",
    "Pose",
    "RayFan",
    "RayGrid",
    "Region",
    "RegionDescription",
    "RescueField",
    "RingShape",
    "SegmentShape",
    "Variation",
    "World",
    "WorldSettings",
    "WorldView",
    "edit_body",
    "insert_body",
    "put_region",
    "redescribe",
    "reorder",
    "sampled_region",
]
