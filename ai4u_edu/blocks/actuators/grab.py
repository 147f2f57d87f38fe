"""A hand."""

import math
from typing import Annotated

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, BodyView, WorldView


class GrabActuator(Actuator):
    """Takes hold of a movable body that the agent touches in front: [grip], 0..1.

    Above 0.5 the hand closes, and it stays closed until the number is 0.5 or less; a decision that
    says nothing of it leaves it as it is. What it holds moves as if it were glued on, and bumps
    into walls for both. In front is what lies within ``angle`` / 2 to either side of the heading,
    centre to centre; of several, the one nearest to the heading.

    The hand opens by itself when one of the two falls out of the world or is put somewhere else,
    and when the agent jumps so high (or falls so low) that they are no longer side by side. It is
    empty at a reset.

    Source: ours.
    """

    action_name: str = "grab"
    angle: Annotated[float, quantity("deg", gt=0, le=360)] = 90.0
    """Whole angle, around the heading, that counts as in front."""

    def space(self) -> Box:
        """[grip]."""
        return Box(0.0, 1.0, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Remembers the world."""
        self._view = view

    def slots(self) -> tuple[str, ...]:
        """The hand."""
        return ("grip",)

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Closes the hand, or opens it."""
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
    """Whether two bodies are side by side, not one above the other."""
    return one.z < other.z + other.height and other.z < one.z + one.height
