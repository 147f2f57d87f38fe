"""From descriptions to pymunk's objects."""

import math
from collections.abc import Sequence

import pymunk

from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.native import FastBody, FastCircle, FastPoly
from ai4u_edu.world.shapes import (
    BodyShape,
    BoxShape,
    CapsuleShape,
    CircleShape,
    PolygonShape,
    SegmentShape,
)

Corner = tuple[float, float]

HAIR = 1e-9
"""Half the thickness of the core of a stick, metres; what it is rounded with makes up the rest."""

_AS_IT_IS = pymunk.Transform.identity()
"""The transform of a polygon's corners; pymunk would make one anew for each."""

KINDS = {
    "static": pymunk.Body.STATIC,
    "dynamic": pymunk.Body.DYNAMIC,
    "kinematic": pymunk.Body.KINEMATIC,
}


def build(body: Body, space: pymunk.Space, group: int) -> None:
    """Makes the body's physical parts and adds them to a space.

    Args:
        body: gets ``_pm`` and ``_shapes``.
        space: where they are added.
        group: a number of the body's own (not 0), so that its own rays don't meet it.
    """
    description = body.sampled
    pm = FastBody(body_type=KINDS[description.kind])
    pm.position = description.position
    pm.angle = math.radians(description.heading_deg)
    if description.kind != "static":
        # a new body rests
        if description.velocity != (0.0, 0.0):
            pm.velocity = description.velocity
        if description.angular_velocity_deg:
            pm.angular_velocity = math.radians(description.angular_velocity_deg)
    shape = make_shape(description.shape, pm)
    dress(shape, description, group)
    if description.kind == "dynamic":
        _give_mass(pm, shape, description)
    space.add(pm, shape)
    body._pm, body._shapes = pm, (shape,)


def make_shape(
    shape: BodyShape, pm: pymunk.Body | None, more: float = 0.0
) -> pymunk.Circle | pymunk.Poly:
    """The pymunk shape of a description, with ``more`` metres all around it."""
    if isinstance(shape, CircleShape):
        return FastCircle(pm, shape.radius + more)
    corners, radius = core(shape)
    return FastPoly(pm, corners, _AS_IT_IS, radius + more)


def core(shape: BodyShape) -> tuple[Sequence[Corner], float]:
    """The corners in the middle of a shape, and the radius that rounds what they span to it."""
    match shape:
        case CircleShape():
            return [(0.0, 0.0)], shape.radius
        case BoxShape() | PolygonShape():
            return shape.outline(), 0.0
        case _:
            # a polygon with a radius, not a Segment: of a ray that comes in through a Segment's
            # round end and leaves through its side, pymunk tells where it leaves; as thin as a
            # hair, not of two corners: those would hold every point in line with them
            a, b, radius = _ends(shape)
            length = math.dist(a, b)
            x, y = HAIR * (a[1] - b[1]) / length, HAIR * (b[0] - a[0]) / length
            corners = [(px + s * x, py + s * y) for (px, py) in (a, b) for s in (1, -1)]
            return corners, max(radius - HAIR, 0.0)


def _ends(shape: CapsuleShape | SegmentShape) -> tuple[Corner, Corner, float]:
    if isinstance(shape, CapsuleShape):
        return (-shape.length / 2, 0.0), (shape.length / 2, 0.0), shape.radius
    return shape.a, shape.b, shape.thickness / 2


def _give_mass(pm: pymunk.Body, shape: pymunk.Shape, description: BodyDescription) -> None:
    form = description.shape
    if not isinstance(form, CapsuleShape | SegmentShape):
        shape.mass = description.mass
        return
    # the mass is spread over the stick, not over the hair in it
    a, b, radius = _ends(form)
    pm.mass = description.mass
    place = pm.position
    pm.center_of_gravity = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    pm.position = place  # the centre of gravity was there until now
    half = ((b[0] - a[0]) / 2, (b[1] - a[1]) / 2)
    pm.moment = pymunk.moment_for_segment(description.mass, (-half[0], -half[1]), half, radius)


def dress(shape: pymunk.Shape, description: BodyDescription, group: int) -> None:
    """Gives a shape its material and its filter."""
    shape.friction = description.friction
    if description.elasticity:  # a new shape has none
        shape.elasticity = description.elasticity
    shape.filter = pymunk.ShapeFilter(
        group=group,
        categories=description.collision_layer,
        mask=description.collision_mask,
    )
