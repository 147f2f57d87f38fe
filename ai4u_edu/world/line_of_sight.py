"""Line of sight between two bodies."""

from typing import TYPE_CHECKING

from ai4u_edu.world.body import BodyView

if TYPE_CHECKING:
    from ai4u_edu.world.world import World


def line_of_sight(world: "World", looker: BodyView, target: BodyView, up: float) -> bool:
    """Return True if the straight line between two bodies' eyes meets no third body.

    Args:
        world: the world of both.
        looker: one end.
        target: the other end.
        up: height of each eye above its body's underside, metres.
    """
    start, rise = looker.z + up, target.z - looker.z
    accept = world.filter_for(looker, 0xFFFFFFFF)
    for hit in world.space.segment_query(looker.position, target.position, 0.0, accept):
        other = world.owners[hit.shape]
        if other is not target and other.z <= start + hit.alpha * rise <= other.z + other.height:
            return False
    return True
