"""One body shape of each type, of similar size."""

from ai4u_edu.world import BoxShape, CapsuleShape, CircleShape, PolygonShape, SegmentShape
from ai4u_edu.world.shapes import BodyShape

SHAPES: list[BodyShape] = [
    CircleShape(radius=0.4),
    BoxShape(size=(1.0, 0.5)),
    PolygonShape(vertices=((-0.5, -0.3), (0.5, -0.3), (0.0, 0.6))),
    CapsuleShape(length=0.8, radius=0.2),
    SegmentShape(a=(-0.5, 0.0), b=(0.5, 0.0), thickness=0.2),
]
