"""An actuator that grabs a body."""

import math
from typing import Annotated

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, BodyView, WorldView


class GrabActuator(Actuator):
    """Grabs a movable body that the agent touches in front: [grip], 0..1.

    Above 0.5 the hand closes, and it stays closed until the number is 0.5 or less; a decision
    without this action changes nothing. The held body moves with the agent as one rigid body, and
    its collisions stop both. In front means within ``angle`` / 2 to either side of the heading,
    centre to centre; of several bodies, the one nearest to the heading is taken.

    The hand opens by itself when one of the two falls out of the world or is moved to another
    place, and when a jump or fall separates them in height. A reset opens it.

    Source: ours.
    """

    action_name: str = "grab"
    angle: Annotated[float, quantity("deg", gt=0, le=360)] = 90.0
    """Whole angle around the heading that counts as in front."""

    def space(self) -> Box:
        """Return the range of the grip."""
        return Box(0.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the world's view."""
        self._view = view

    def slots(self) -> tuple[str, ...]:
        """Return the name of the number."""
        return ("grip",)

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Close or open the hand."""
        held = body.held
        if held is not None and (action[0] <= 0.5 or not _level(body, held)):
            body.release()
        elif held is None and action[0] > 0.5:
            found = self._in_front(body)
            if found is not None:
                body.hold(found)

    def _in_front(self, body: Body) -> BodyView | None:
        touched = [self._view[name] for name in self._view.contacts(body)]
        aside = {
            other: abs(body.bearing(other))
            for other in touched
            if other.moves and _level(body, other)
        }
        nearest = min(aside, key=lambda other: (aside[other], other.name), default=None)
        if nearest is None or aside[nearest] > math.radians(self.angle) / 2:
            return None
        return nearest


def _level(one: BodyView, other: BodyView) -> bool:
    """Return True if two bodies overlap in height, so that one is not above the other."""
    return one.z < other.z + other.height and other.z < one.z + one.height
