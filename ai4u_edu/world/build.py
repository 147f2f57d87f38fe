"""pymunk's objects made from descriptions."""

import math
from collections.abc import Sequence

import pymunk

from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.shapes import (
    BodyShape,
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    SegmentShape,
)

_Corner = tuple[float, float]

_STICK_CORE_RADIUS_M = 1e-9
"""Half the thickness of a stick's polygon, metres; the polygon's radius adds the rest."""

_IDENTITY = pymunk.Transform.identity()
"""Transform of a polygon's corners; pymunk would construct one for each polygon."""

KINDS = {
    "static": pymunk.Body.STATIC,
    "dynamic": pymunk.Body.DYNAMIC,
    "kinematic": pymunk.Body.KINEMATIC,
}


class _PlainAttributes:
    # pymunk sets attributes through a Python method that adds nothing for ours; a reset of the
    # world would call it some two hundred times
    __setattr__ = object.__setattr__


class FastBody(_PlainAttributes, pymunk.Body):
    """A pymunk body that is constructed faster."""


class FastCircle(_PlainAttributes, pymunk.Circle):
    """A pymunk circle that is constructed faster."""


class FastPoly(_PlainAttributes, pymunk.Poly):
    """A pymunk polygon that is constructed faster."""


def build(body: Body, space: pymunk.Space, group: int) -> None:
    """Make a body's pymunk objects and add them to a space.

    Args:
        body: its ``_pm`` and ``_shapes`` are set.
        space: the space to add to.
        group: a number of the body alone (not 0), so that its own rays don't hit it.
    """
    description = body.sampled
    pm = FastBody(body_type=KINDS[description.kind])
    pm.position = description.position
    pm.angle = math.radians(description.heading_deg)
    if description.kind != "static":
        # a new pymunk body is at rest
        if description.velocity != (0.0, 0.0):
            pm.velocity = description.velocity
        if description.angular_velocity_deg:
            pm.angular_velocity = math.radians(description.angular_velocity_deg)
    shape = make_shape(description.shape, pm)
    set_material(shape, description, group)
    if description.kind == "dynamic":
        _give_mass(pm, shape, description)
    space.add(pm, shape)
    body._pm, body._shapes = pm, (shape,)


def make_shape(
    shape: BodyShape, pm: pymunk.Body | None, more: float = 0.0
) -> pymunk.Circle | pymunk.Poly:
    """Return the pymunk shape of a description, grown by ``more`` metres on all sides."""
    if isinstance(shape, CircleShape):
        return FastCircle(pm, shape.radius + more)
    corners, radius = core(shape)
    return FastPoly(pm, corners, _IDENTITY, radius + more)


def core(shape: BodyShape) -> tuple[Sequence[_Corner], float]:
    """Return corners and radius: the shape is the corners' convex hull, grown by the radius."""
    match shape:
        case CircleShape():
            return [(0.0, 0.0)], shape.radius
        case BoxShape() | PolygonShape():
            return shape.outline(), 0.0
        case _:
            # a polygon with a radius, not a Segment: for a ray that enters a Segment through its
            # round end and leaves it through its side, pymunk returns where it leaves. The polygon
            # needs some thickness: one of two corners would contain every point in line with them
            a, b, radius = _ends(shape)
            length = math.dist(a, b)
            x, y = (
                _STICK_CORE_RADIUS_M * (a[1] - b[1]) / length,
                _STICK_CORE_RADIUS_M * (b[0] - a[0]) / length,
            )
            corners = [(px + s * x, py + s * y) for (px, py) in (a, b) for s in (1, -1)]
            return corners, max(radius - _STICK_CORE_RADIUS_M, 0.0)


def _ends(shape: CapsuleShape | SegmentShape) -> tuple[_Corner, _Corner, float]:
    if isinstance(shape, CapsuleShape):
        return (-shape.length / 2, 0.0), (shape.length / 2, 0.0), shape.radius
    return shape.a, shape.b, shape.thickness / 2


def _give_mass(pm: pymunk.Body, shape: pymunk.Shape, description: BodyDescription) -> None:
    form = description.shape
    if not isinstance(form, CapsuleShape | SegmentShape):
        shape.mass = description.mass
        return
    # the mass is spread over the whole stick, not over its thin polygon
    a, b, radius = _ends(form)
    pm.mass = description.mass
    place = pm.position
    pm.center_of_gravity = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    pm.position = place  # setting the centre of gravity has moved it
    half = ((b[0] - a[0]) / 2, (b[1] - a[1]) / 2)
    pm.moment = pymunk.moment_for_segment(description.mass, (-half[0], -half[1]), half, radius)


def set_material(shape: pymunk.Shape, description: BodyDescription, group: int) -> None:
    """Set a shape's material and filter."""
    shape.friction = description.friction
    if description.elasticity:  # a new pymunk shape has none
        shape.elasticity = description.elasticity
    shape.filter = pymunk.ShapeFilter(
        group=group,
        categories=description.collision_layer,
        mask=description.collision_mask,
    )
