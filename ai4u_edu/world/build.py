"""From descriptions to pymunk's objects."""

import math

import pymunk

from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.shapes import BodyShape, BoxShape, CapsuleShape, CircleShape, PolygonShape

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
    description = body.description
    pm = pymunk.Body(body_type=KINDS[description.kind])
    pm.position = description.position
    pm.angle = math.radians(description.heading_deg)
    if description.kind != "static":
        pm.velocity = description.velocity
        pm.angular_velocity = math.radians(description.angular_velocity_deg)
    shape = make_shape(description.shape, pm)
    dress(shape, description, group)
    space.add(pm, shape)
    body._pm, body._shapes = pm, (shape,)


def make_shape(shape: BodyShape, pm: pymunk.Body | None) -> pymunk.Shape:
    """The pymunk shape of a description."""
    match shape:
        case CircleShape():
            return pymunk.Circle(pm, shape.radius)
        case BoxShape():
            return pymunk.Poly(pm, shape.outline())
        case PolygonShape():
            return pymunk.Poly(pm, shape.vertices)
        case CapsuleShape():
            half = shape.length / 2
            return pymunk.Segment(pm, (-half, 0), (half, 0), shape.radius)
        case _:
            return pymunk.Segment(pm, shape.a, shape.b, shape.thickness / 2)


def dress(shape: pymunk.Shape, description: BodyDescription, group: int) -> None:
    """Gives a shape its material and its filter."""
    if description.kind == "dynamic":
        shape.mass = description.mass
    shape.friction = description.friction
    shape.elasticity = description.elasticity
    shape.filter = pymunk.ShapeFilter(
        group=group,
        categories=description.collision_layer,
        mask=description.collision_mask,
    )
